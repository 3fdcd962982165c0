#include "rhombicSurfaceRequest.h"

#include "rhombicFailure.h"

#include <gtest/gtest.h>

#include <vtkNamedColors.h>
#include <vtkNew.h>

#include <sstream>

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
  EXPECT_FALSE(request.insideIsBelow);
  EXPECT_EQ(request.colour, (rhombic::Colour{ 1.0, 128.0 / 255.0, 0.0 }));
  EXPECT_EQ(request.opacity, 0.5);
}

TEST(SurfaceRequest, ColoursAreDigitsOrNamesOfCSS)
{
  using rhombic::ParseColour;
  EXPECT_EQ(ParseColour("#fff"), (rhombic::Colour{ 1.0, 1.0, 1.0 }));
  EXPECT_EQ(ParseColour("#F80"), ParseColour("#ff8800"));
  EXPECT_EQ(ParseColour("White"), ParseColour("#ffffff"));
  EXPECT_EQ(ParseColour("rebeccapurple"), ParseColour("#663399"));
  for (const auto & [british, american] : { std::pair("grey", "gray"),
                                            std::pair("darkgrey", "darkgray"),
                                            std::pair("darkslategrey", "darkslategray"),
                                            std::pair("dimgrey", "dimgray"),
                                            std::pair("lightgrey", "lightgray"),
                                            std::pair("lightslategrey", "lightslategray"),
                                            std::pair("slategrey", "slategray") })
  {
    EXPECT_EQ(ParseColour(british), ParseColour(american)) << british;
  }
  EXPECT_EQ(ParseColour("gray"), ParseColour("#808080"));
}

/** VTK knows 140 of the 148 names, one of them with another value, besides many of its own. */
TEST(SurfaceRequest, NamedColoursAreThoseOfVTK)
{
  const vtkNew<vtkNamedColors> known;
  std::istringstream names(known->GetColorNames());
  std::size_t count = 0;
  for (std::string name; std::getline(names, name);)
  {
    rhombic::Colour colour;
    try
    {
      colour = rhombic::ParseColour(name);
    }
    catch (const Failure &)
    {
      continue; // VTK's own
    }
    ++count;
    rhombic::Colour expected;
    known->GetColorRGB(name, expected.data());
    if (name != "grey") // VTK's is CSS's silver
    {
      EXPECT_EQ(colour, expected) << name;
    }
  }
  EXPECT_EQ(count, 141u);
}

TEST(SurfaceRequest, HasDefaultsAndOtherThresholds)
{
  const auto skin = rhombic::ParseSurfaceRequest("skin=-300.5", 1);
  EXPECT_EQ(skin.isovalue, -300.5);
  EXPECT_EQ(skin.opacity, 1.0);
  EXPECT_NE(skin.colour, rhombic::ParseSurfaceRequest("skin=-300.5", 0).colour) << "each place has its own colour";
  EXPECT_FALSE(rhombic::ParseSurfaceRequest("head=otsu,,0.5", 0).isovalue.has_value());
  const auto air = rhombic::ParseSurfaceRequest("air=<-500.5", 0);
  EXPECT_TRUE(air.insideIsBelow);
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
                             "bone=1,rot",
                             "bone=1,#12",
                             "bone=1,#1234",
                             "bone=1,fff",
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

TEST(ResolveIsovalues, FillsInOtsusAndRefusesWhatIsOutside)
{
  const rhombic::Intensities intensities{ -1000.0, 2000.0, -100.5, -700.5, -900.5, 600.5 };
  const auto resolved = rhombic::ResolveIsovalues({ rhombic::ParseSurfaceRequest("a=otsu", 0),
                                                    rhombic::ParseSurfaceRequest("b=2000", 1),
                                                    rhombic::ParseSurfaceRequest("c=otsu-low", 2),
                                                    rhombic::ParseSurfaceRequest("d=otsu-lowest", 3),
                                                    rhombic::ParseSurfaceRequest("e=<otsu-high", 4) },
                                                  intensities);
  EXPECT_EQ(resolved[0].isovalue, -100.5);
  EXPECT_EQ(resolved[1].isovalue, 2000.0);
  EXPECT_EQ(resolved[2].isovalue, -700.5);
  EXPECT_EQ(resolved[3].isovalue, -900.5);
  EXPECT_EQ(resolved[4].isovalue, 600.5);
  for (const char * text : { "bone=2000.5", "bone=-1000", "bone=-5000" })
  {
    try
    {
      rhombic::ResolveIsovalues({ rhombic::ParseSurfaceRequest(text, 0) }, intensities);
      ADD_FAILURE() << text;
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), FailureKind::Empty);
      EXPECT_NE(std::string(failure.GetDescription()).find("from -1000 to 2000"), std::string::npos);
    }
  }
}

} // namespace
