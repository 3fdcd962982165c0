#include "rhombicFailure.h"

#include <gtest/gtest.h>

#include <string>

namespace
{

TEST(Failure, TellsWhereItWasThrown)
{
  unsigned int line = 0;
  try
  {
    line = __LINE__ + 1;
    throw rhombic::Failure(rhombic::FailureKind::Usage, "One sentence.");
  }
  catch (const itk::ExceptionObject & error)
  {
    const std::string file = error.GetFile();
    EXPECT_NE(file.find("rhombicFailureGTest.cxx"), std::string::npos) << file;
    EXPECT_EQ(error.GetLine(), line);
    EXPECT_STREQ(error.GetLocation(), "TestBody");
    EXPECT_STREQ(error.GetDescription(), "One sentence.");
  }
}

} // namespace
