#ifndef rhombicFuzzMutation_h
#define rhombicFuzzMutation_h

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rhombicfuzz
{

/** \class FuzzRandom
 * \brief Xorshift (Marsaglia 2003), the same numbers everywhere. */
class FuzzRandom
{
public:
  explicit FuzzRandom(std::uint64_t seed);

  std::uint64_t
  Next();

  /** From 0 up to, but without, \a end. */
  std::size_t
  Below(std::size_t end);

private:
  std::uint64_t m_State;
};

/** One of the seeds, damaged in one to eight places: flipped bits, awkward integers over or between its bytes, bytes
 * taken out, the end cut off, or a piece of another seed. */
std::string
Mutate(const std::vector<std::string> & seeds, FuzzRandom & random);

} // namespace rhombicfuzz

#endif
