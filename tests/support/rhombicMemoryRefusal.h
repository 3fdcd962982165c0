#ifndef rhombicMemoryRefusal_h
#define rhombicMemoryRefusal_h

#include "rhombicFailure.h"

#include <gtest/gtest.h>

#include <string>

namespace rhombictest
{

/** The sentence of the Failure(Memory) that \a work throws; "no exception" when there is none. */
template <typename TWork>
std::string
MemoryRefusal(const TWork & work)
{
  try
  {
    work();
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Memory);
    return failure.GetDescription();
  }
  return "no exception";
}

} // namespace rhombictest

#endif
