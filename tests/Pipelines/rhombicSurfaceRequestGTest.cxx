#include "rhombicSurfaceRequest.h"

#include "rhombicFailure.h"

#include <gtest/gtest.h>

namespace
{

using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::SurfaceRequest;

TEST(SurfaceRequest, ReadsNameThresholdColourAndOpacity)
{
  const auto request = rhombic::ParseSurfaceRequest("bone=250.5,#ff8000,0.5", 0);
  EXPECT_EQ(request.name, "bone");
  EXPECT_EQ(request.isovalue, 250.5);
  EXPECT_EQ(request.side, SurfaceRequest::Side::Above);
  EXPECT_EQ(request.colour, (rhombic::Colour{ 1.0, 128.0 / 255.0, 0.0 }));
  EXPECT_EQ(request.opacity, 0.5);
}

TEST(SurfaceRequest, HasDefaultsAndOtherThresholds)
{
  const auto skin = rhombic::ParseSurfaceRequest("skin=-300.5", 1);
  EXPECT_EQ(skin.isovalue, -300.5);
  EXPECT_EQ(skin.opacity, 1.0);
  EXPECT_NE(skin.colour, rhombic::ParseSurfaceRequest("skin=-300.5", 0).colour) << "each place has its own colour";
  EXPECT_FALSE(rhombic::ParseSurfaceRequest("head=otsu,,0.5", 0).isovalue.has_value());
  const auto air = rhombic::ParseSurfaceRequest("air=<-500.5", 0);
  EXPECT_EQ(air.side, SurfaceRequest::Side::Below);
  EXPECT_EQ(air.isovalue, -500.5);
}

TEST(SurfaceRequest, RefusesWhatItCannotRead)
{
  for (const char * text : { "",
                             "bone",
                             "=250",
                             "bone=",
                             "bone=abc",
                             "bone=12x",
                             "bone=nan",
                             "bone=inf",
                             "bone=1,red",
                             "bone=1,#12345",
                             "bone=1,#12345g",
                             "bone=1,#123456,0",
                             "bone=1,#123456,1.5",
                             "bone=1,#123456,x",
                             "bone=1,#123456,1,1" })
  {
    try
    {
      rhombic::ParseSurfaceRequest(text, 0);
      ADD_FAILURE() << text;
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), FailureKind::Usage);
      EXPECT_NE(std::string(failure.GetDescription()).find("for example"), std::string::npos);
    }
  }
}

} // namespace
