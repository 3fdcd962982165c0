#include "rhombicMemoryBudget.h"

#include "rhombicFailure.h"

#include <gtest/gtest.h>

namespace
{

using rhombic::RequireMemory;

TEST(MemoryBudget, MoreThanAllowedIsRefusedInWords)
{
  constexpr std::uintmax_t gibibyte = 1 << 30;
  EXPECT_NO_THROW(RequireMemory(gibibyte, gibibyte, "Cannot read a.nii"));
  try
  {
    RequireMemory(3 * gibibyte, 2 * gibibyte, "Cannot read a.nii");
    FAIL() << "it was allowed";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Memory);
    EXPECT_STREQ(failure.GetDescription(),
                 "Cannot read a.nii: it would need 3 GiB, more than the 2 GiB allowed; raise --max-memory or crop the "
                 "scan.");
  }
}

TEST(MemoryBudget, HalfOfTheFreeMemoryIsAllowedByDefault)
{
  EXPECT_NO_THROW(RequireMemory(1, 0, "Cannot read a.nii"));
  if (const auto free = rhombic::FreeMemory(); free > 0)
  {
    EXPECT_THROW(RequireMemory(2 * free, 0, "Cannot read a.nii"), rhombic::Failure);
  }
}

} // namespace
