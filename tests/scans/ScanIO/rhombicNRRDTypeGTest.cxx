#include "rhombicTextHeader.h"

#include <gtest/gtest.h>

namespace
{

using rhombic::CanonicalNRRDType;

TEST(NRRDType, HasOneNameForAllOfTheFormats)
{
  for (const char * const name : { "short", "short int", "signed short", "signed short int", "int16", "int16_t" })
  {
    EXPECT_EQ(CanonicalNRRDType(name), "int16") << name;
  }
  EXPECT_EQ(CanonicalNRRDType("Unsigned Char"), "uint8");
  EXPECT_EQ(CanonicalNRRDType("FLOAT"), "float");
  EXPECT_EQ(CanonicalNRRDType("signed long long int"), "int64");
}

TEST(NRRDType, HasNoNameForOtherTexts)
{
  for (const char * const name : { "", "block", "char", "int 16", "short\n" })
  {
    EXPECT_EQ(CanonicalNRRDType(name), "") << name;
  }
}

} // namespace
