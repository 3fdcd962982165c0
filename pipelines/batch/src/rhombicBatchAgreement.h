#ifndef rhombicBatchAgreement_h
#define rhombicBatchAgreement_h

#include "rhombicScanReport.h"

#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * The agreement of cases' labels with their references, from the cases' lines in the journal. Thread safe. */

/** Whether any case was compared with its reference. */
bool
HasAgreement(const std::vector<Report> & cases);

/** A line for each compared label of each case, with the columns of `rhombic compare-labels`. */
std::string
MakeAgreementTable(const std::vector<Report> & cases);

/** A line for each measure of each label over all cases: in how many cases the label is compared or missing, and mean,
 * least value, quartiles and largest value of the cases that have the measure. */
std::string
MakeAgreementStatistics(const std::vector<Report> & cases);

/** The cases with most missing labels first, then those with the largest HD95 of a label; those without a comparison
 * last. Equal ones keep their order. */
std::vector<Report>
WorstFirst(std::vector<Report> cases);

/** Sentences on the missing labels of a case, its worst label and its mean Dice; empty without a comparison. */
std::vector<std::string>
SummarizeAgreementOf(const Report & record);

} // namespace rhombic

#endif
