#ifndef rhombicPairedTimes_h
#define rhombicPairedTimes_h

#include <chrono>
#include <vector>

namespace rhombic
{

/** \class PairedTimes
 * \brief Seconds of two pieces of work that were run in turn, A B A B ..., so that what else the machine does, and its
 * clock, meet both alike. */
struct PairedTimes
{
  std::vector<double> reference;
  std::vector<double> candidate;

  /** How many times faster the candidate is: reference / candidate of each pair. */
  std::vector<double>
  GetRatios() const;
};

/** The middle value, or the mean of the two middle ones. Of no values: not a number. */
double
Median(std::vector<double> values);

/** Seconds that \a work() takes. What it returns is destroyed after the clock has stopped. */
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

/** Runs both in turn, the given number of times each. Where that is more than once, one more run before is not counted:
 * it pays for memory that the machine hands out for the first time. */
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
