#ifndef rhombicBatchStatistics_h
#define rhombicBatchStatistics_h

#include <filesystem>
#include <string>

namespace rhombic
{

/** Summarizes measures.tsv in a folder of outputs: writes statistics.tsv there, a line for each measure of each
 * surface, with number of cases, least value, quartiles and largest value, and the cases that lie apart. Surfaces of
 * one name that are finished differently for several outputs (outputs.tsv) have lines of their own. Returns the same
 * with blanks instead of tabs, to be read.
 *
 * Quartiles are interpolated between the sorted values (Hyndman and Fan 1996, type 7). A value lies apart when it
 * differs from the median by more than 3.5 standard deviations, which are estimated as 1.4826 times the median of all
 * such differences (Iglewicz and Hoaglin 1993), or, where more than half of the values are the same, as 1.2533 times
 * their mean. Of fewer than 5 values, none does.
 *
 * Throws Failure: NotFound and Unreadable without measures.tsv and outputs.tsv of this version, Output. */
std::string
WriteBatchStatistics(const std::filesystem::path & folder);

} // namespace rhombic

#endif
