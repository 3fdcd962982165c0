#ifndef rhombicPairedTimes_h
#define rhombicPairedTimes_h

#include <chrono>
#include <vector>

namespace rhombic
{

/** \class PairedTimes
 * \brief Times in seconds of two functions that were run in turn, A B A B ..., so that other work on the machine and
 * changes of its clock affect both alike. */
struct PairedTimes
{
  std::vector<double> reference;
  std::vector<double> candidate;

  /** reference / candidate of each pair: how many times faster the candidate is. */
  std::vector<double>
  GetRatios() const;
};

/** The middle value, or the mean of the two middle ones. Not a number if there are no values. */
double
Median(std::vector<double> values);

/** The time of \a work() in seconds, without the destruction of its result. */
template <typename TWork>
double
TimeOf(const TWork & work)
{
  const auto begin = std::chrono::steady_clock::now();
  const auto result = work();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
  static_cast<void>(result);
  return time.count();
}

/** Runs both functions in turn, \a repeats times each. If that is more than once, a run before the first one is not
 * counted: it includes the time for memory that the system hands out for the first time. */
template <typename TReference, typename TCandidate>
PairedTimes
TimePairs(unsigned int repeats, const TReference & reference, const TCandidate & candidate)
{
  if (repeats > 1)
  {
    TimeOf(reference);
    TimeOf(candidate);
  }
  PairedTimes times;
  for (unsigned int i = 0; i < repeats; ++i)
  {
    times.reference.push_back(TimeOf(reference));
    times.candidate.push_back(TimeOf(candidate));
  }
  return times;
}

} // namespace rhombic

#endif
