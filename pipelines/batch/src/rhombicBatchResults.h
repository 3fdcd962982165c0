#ifndef rhombicBatchResults_h
#define rhombicBatchResults_h

#include "rhombicBatchCases.h"
#include "rhombicScanReport.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** The small picture in a case's folder, which `rhombic render` makes. */
constexpr char ThumbnailFile[] = "thumbnail.jpg";

/** The report in a case's folder of all that is there. */
constexpr char CaseFile[] = "case.json";

/** The texts of a list in a case's line of the journal, with a comma between them. */
std::string
ListOf(const Report & record, const std::string & key);

/** A line of a table. */
std::string
ToLine(const std::vector<std::string> & fields);

/** Writes results.tsv, results.json, measures.tsv, outputs.tsv, the descriptions of these two, and index.html from the
 * cases' lines in the journal; agreement.tsv and agreement-statistics.tsv if cases were compared with references, else
 * removes these two; and cases.tsv, a manifest of \a manifest for its owner alone, or removes it if that is
 * null. Throws Failure(Output). */
void
WriteResults(const std::vector<Report> & cases,
             const std::vector<BatchCase> * manifest,
             const std::filesystem::path & folder);

} // namespace rhombic

#endif
