#include "rhombicMemoryBudget.h"

#include "rhombicFailure.h"

#include <gtest/gtest.h>

namespace
{

using rhombic::RequireMemory;

TEST(MemoryBudget, MoreThanAllowedIsRefusedInWords)
{
  constexpr std::uintmax_t gibibyte = 1 << 30;
  EXPECT_NO_THROW(RequireMemory(gibibyte, gibibyte, "Reading a.nii"));
  try
  {
    RequireMemory(5 * gibibyte / 2, 2 * gibibyte, "Reading a.nii", "crop the scan");
    FAIL() << "it was allowed";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Memory);
    EXPECT_STREQ(failure.GetDescription(),
                 "Reading a.nii would need 2.5 GiB, more than the 2.0 GiB that are allowed; allow more with "
                 "maximumMemory = 3G, or crop the scan.");
  }
}

TEST(MemoryBudget, HalfOfTheFreeMemoryIsAllowedByDefault)
{
  EXPECT_NO_THROW(RequireMemory(1, 0, "Reading a.nii"));
  if (const auto free = rhombic::FreeMemory(); free > 0)
  {
    EXPECT_THROW(RequireMemory(2 * free, 0, "Reading a.nii"), rhombic::Failure);
  }
}

} // namespace
