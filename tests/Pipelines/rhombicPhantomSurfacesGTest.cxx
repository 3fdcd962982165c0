#include "rhombicLatticePipeline.h"
#include "rhombicPhantom.h"

#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

namespace
{

using rhombic::SurfaceRequest;

const rhombic::FCCVolume &
PhantomOnTheLattice()
{
  static const rhombic::FCCVolume volume = rhombic::ScanToLattice(rhombic::MakePhantomScan(), {}, {});
  return volume;
}

itk::TriangleSurface::ConstPointer
Extract(const std::string & request, SurfaceRequest::Parts parts = SurfaceRequest::Parts::All)
{
  SurfaceRequest parsed = rhombic::ParseSurfaceRequest(request, 0);
  parsed.parts = parts;
  return rhombic::LatticeToSurfaces(PhantomOnTheLattice(), { parsed }, {}).front().surface;
}

double
CentroidX(const itk::TriangleSurface & surface)
{
  double sum = 0.0;
  for (const auto & point : surface.GetPoints())
  {
    sum += point[0];
  }
  return sum / static_cast<double>(surface.GetNumberOfPoints());
}

// From the analytic body through sampling, resampling and extraction: what comes out is what went in. A threshold's surface
// lies where the ideal one does only half way between two tissues, so bone against muscle at (50 + 800) / 2 and so on; at
// other thresholds the partial volume of a voxel moves it by a fraction of one.
TEST(PhantomSurfaces, EncloseTheKnownVolumes)
{
  const auto skin = Extract("skin=-500.5");
  EXPECT_TRUE(ComputeTopology(*skin).IsWatertight());
  const double exactSkin = rhombic::PhantomEnclosedBy(-500.5).volume;
  EXPECT_NEAR(ComputeVolume(*skin) / exactSkin, 1.0, 0.002);

  const auto bone = Extract("bone=425.5");
  EXPECT_TRUE(ComputeTopology(*bone).IsWatertight());
  const double exactBone = rhombic::PhantomEnclosedBy(425.5).volume;
  EXPECT_NEAR(ComputeVolume(*bone) / exactBone, 1.0, 0.03);
}

TEST(PhantomSurfaces, TheEnclosedAirIsTheLungsAndTheAirway)
{
  const auto lungs = Extract("lungs=<-400.5", SurfaceRequest::Parts::Enclosed);
  const auto topology = ComputeTopology(*lungs);
  EXPECT_TRUE(topology.IsWatertight());
  EXPECT_EQ(topology.components, 1u);
  const auto bounds = lungs->GetBounds();
  const auto body = Extract("skin=-500.5")->GetBounds();
  for (unsigned int axis = 0; axis < 2; ++axis)
  {
    EXPECT_GT(bounds[2 * axis], body[2 * axis]);
    EXPECT_LT(bounds[2 * axis + 1], body[2 * axis + 1]);
  }
}

TEST(PhantomSurfaces, TheMarkerIsOnThePatientsLeftInFront)
{
  const auto marker = Extract("marker=1800.5");
  EXPECT_GT(CentroidX(*marker), 20.0) << "LPS: left is +x";
  const auto bounds = marker->GetBounds();
  EXPECT_LT(bounds[3], Extract("skin=-500.5")->GetBounds()[3]) << "LPS: the front is -y";
}

} // namespace
