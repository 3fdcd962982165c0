#include "rhombicFailure.h"
#include "rhombicScanReport.h"
#include "rhombicScanToLattice.h"

#include <gtest/gtest.h>

namespace
{

using rhombic::Denoising;
using Kind = Denoising::Kind;

TEST(Denoising, IsParsed)
{
  EXPECT_EQ(rhombic::ParseDenoising("none").kind, Kind::None);
  const Denoising gaussian = rhombic::ParseDenoising("gaussian:0.75");
  EXPECT_EQ(gaussian.kind, Kind::Gaussian);
  EXPECT_EQ(gaussian.sigma, 0.75);
  const Denoising edges = rhombic::ParseDenoising("edges:1,60.5");
  EXPECT_EQ(edges.kind, Kind::EdgePreserving);
  EXPECT_EQ(edges.sigma, 1.0);
  EXPECT_EQ(edges.edge, 60.5);
  for (const char * text : { "",
                             "gauss:1",
                             "gaussian",
                             "gaussian:",
                             "gaussian:x",
                             "gaussian:1mm",
                             "gaussian:1,2",
                             "gaussian:0",
                             "gaussian:-1",
                             "gaussian:nan",
                             "gaussian:inf",
                             "none:1",
                             "edges:1",
                             "edges:1,",
                             "edges:1,0",
                             "edges:,60",
                             "edges:1,-60",
                             "edges:1,60,2",
                             "edges:0,60" })
  {
    try
    {
      rhombic::ParseDenoising(text);
      ADD_FAILURE() << text;
    }
    catch (const rhombic::Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Usage) << text;
    }
  }
}

TEST(Denoising, IsReported)
{
  EXPECT_EQ(rhombic::ReportDenoising({}).dump(), R"({"kind":"none"})");
  EXPECT_EQ(rhombic::ReportDenoising({ Kind::Gaussian, 0.5 }).dump(), R"({"kind":"gaussian","sigma":0.5})");
  EXPECT_EQ(rhombic::ReportDenoising({ Kind::EdgePreserving, 0.5, 60.0 }).dump(),
            R"({"kind":"edges","sigma":0.5,"edge":60.0})");
}

} // namespace
