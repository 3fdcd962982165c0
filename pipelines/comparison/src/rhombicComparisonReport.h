#ifndef rhombicComparisonReport_h
#define rhombicComparisonReport_h

#include "rhombicComparison.h"

namespace rhombic
{

/** A name for a row: its method, its share of the reference's samples, and whether these are resampled. */
std::string
LabelOf(const ExperimentResult & result, std::size_t row);

/** A picture on the page. */
struct PagePicture
{
  std::string file;
  std::string caption;
};

/** A text with figures in place of ${...}. Throws Failure(Unreadable) for a figure that is not there. */
std::string
FillIn(const std::string & text, const std::vector<ExperimentResult> & all);

/** The section of one experiment: table, text and pictures. */
std::string
MarkdownOf(const ExperimentResult & result,
           const std::vector<ExperimentResult> & all,
           const std::vector<PagePicture> & pictures);

/** The table of claims. */
std::string
MarkdownOf(const std::vector<Claim> & claims, const std::vector<ExperimentResult> & all);

/** All figures but times, a line for each row. */
std::string
FiguresAsCsv(const std::vector<ExperimentResult> & all);

/** Median times in ms on one thread, and their ratios to the reference's. */
std::string
TimesAsCsv(const std::vector<ExperimentResult> & all);

/** All figures. */
std::string
FiguresAsJson(const std::vector<ExperimentResult> & all);

} // namespace rhombic

#endif
