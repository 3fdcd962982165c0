#ifndef rhombicMemoryRefusal_h
#define rhombicMemoryRefusal_h

#include "rhombicFailure.h"

#include <gtest/gtest.h>

#include <string>

namespace rhombictest
{

/** The sentence of the Failure of a kind that \a work throws; "no exception" when there is none. */
template <typename TWork>
std::string
Refusal(const TWork & work, rhombic::FailureKind kind)
{
  try
  {
    work();
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), kind);
    return failure.GetDescription();
  }
  return "no exception";
}

template <typename TWork>
std::string
MemoryRefusal(const TWork & work)
{
  return Refusal(work, rhombic::FailureKind::Memory);
}

} // namespace rhombictest

#endif
