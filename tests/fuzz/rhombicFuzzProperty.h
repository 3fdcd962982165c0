#ifndef rhombicFuzzProperty_h
#define rhombicFuzzProperty_h

#include <cstdio>
#include <cstdlib>

namespace rhombicfuzz
{

/** Ends the process, which fuzzers take for a crash, when a property that a parser promises does not hold. */
inline void
Require(bool holds, const char * property)
{
  if (!holds)
  {
    std::fprintf(stderr, "This does not hold: %s\n", property);
    std::abort();
  }
}

} // namespace rhombicfuzz

#endif
