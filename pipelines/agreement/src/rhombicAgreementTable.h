#ifndef rhombicAgreementTable_h
#define rhombicAgreementTable_h

#include "rhombicCompareLabels.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Rows of all columns, one for each label, and the last one of the means: counts of missing labels are in its status.
 * The settings tell whether there are columns of parts and of voxel metrics. */
Report
ReportAgreement(const std::vector<LabelAgreement> & labels, const CompareLabelsSettings & settings);

/** The rows as text: between commas for .csv, between tabs for .tsv, else as JSON. */
std::string
WriteAgreement(const Report & rows, const std::string & extension);

/** Throws Failure(Usage) for an extension other than .csv, .tsv and .json. */
void
CheckAgreementPath(const std::filesystem::path & path);

/** The main measures of a label in one line. */
std::string
SummarizeAgreement(const LabelAgreement & label);

} // namespace rhombic

#endif
