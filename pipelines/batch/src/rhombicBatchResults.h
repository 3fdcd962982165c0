#ifndef rhombicBatchResults_h
#define rhombicBatchResults_h

#include "rhombicScanReport.h"

#include <filesystem>
#include <vector>

namespace rhombic
{

/** The small picture in a case's folder, which `rhombic render` makes. */
constexpr char ThumbnailFile[] = "thumbnail.jpg";

/** Writes results.tsv, results.json, measures.tsv and index.html from the cases' lines in the journal. Throws
 * Failure(Output). */
void
WriteResults(const std::vector<Report> & cases, const std::filesystem::path & folder);

/** The page of WriteResults(): a table of all cases with thumbnails and links, which a script on the page filters. It
 * needs nothing beside the folder. */
std::string
MakeIndexPage(const std::vector<Report> & cases);

} // namespace rhombic

#endif
