#include "rhombicFailure.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicPhantom.h"

#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{

using Mode = itk::FCCIsosurfaceMode;
using rhombic::SurfaceRequest;

rhombic::Scan
PhantomScan()
{
  rhombic::Scan scan;
  scan.image = rhombic::MakePhantomScan();
  return scan;
}

const rhombic::FCCVolume &
PhantomOnTheLattice()
{
  static const rhombic::FCCVolume volume = rhombic::ScanToLattice(PhantomScan(), {}, {});
  return volume;
}

itk::TriangleSurface::ConstPointer
Extract(const std::string & request, SurfaceRequest::Parts parts = SurfaceRequest::Parts::All, Mode mode = Mode::Lean)
{
  SurfaceRequest parsed = rhombic::ParseSurfaceRequest(request, 0);
  parsed.parts = parts;
  return rhombic::LatticeToSurfaces(PhantomOnTheLattice(), { parsed }, mode, {}).front().surface;
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

// From the analytic body through sampling, resampling and extraction: what comes out is what went in. A surface lies
// where the ideal one does when its threshold is half way between the tissues on both sides: air and skin at -485,
// muscle and most bones at about 375, lungs and muscle at -400.
TEST(PhantomSurfaces, EncloseTheKnownVolumesInEveryMode)
{
  for (const Mode mode : { Mode::Tetrahedra, Mode::Octahedra, Mode::Parallelepipeds, Mode::Fine, Mode::Lean })
  {
    const auto skin = Extract("skin=-485.5", SurfaceRequest::Parts::All, mode);
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*skin).IsWatertight()) << mode;
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*skin) / rhombic::PhantomEnclosedBy(-485.5).volume, 1.0, 0.002) << mode;

    const auto bone = Extract("bone=375.5", SurfaceRequest::Parts::All, mode);
    EXPECT_TRUE(ComputeTriangleSurfaceTopology(*bone).IsWatertight()) << mode;
    EXPECT_NEAR(ComputeTriangleSurfaceVolume(*bone) / rhombic::PhantomEnclosedBy(375.5).volume, 1.0, 0.02) << mode;
  }
}

TEST(PhantomSurfaces, LeanHasAThirdOfTheTriangles)
{
  const auto lean = Extract("skin=-485.5")->GetNumberOfTriangles();
  for (const Mode mode : { Mode::Tetrahedra, Mode::Fine })
  {
    const auto other = Extract("skin=-485.5", SurfaceRequest::Parts::All, mode)->GetNumberOfTriangles();
    EXPECT_LT(lean, other * 2 / 5) << mode;
    EXPECT_GT(lean, other / 5) << mode;
  }
}

TEST(PhantomSurfaces, SeveralRequestsGiveTheSurfacesOfEach)
{
  const std::vector<std::string> texts{ "lungs=<-400.5", "skin=-485.5", "bone=375.5" };
  std::vector<SurfaceRequest> requests;
  for (const std::string & text : texts)
  {
    requests.push_back(rhombic::ParseSurfaceRequest(text, 0));
  }
  const auto together = rhombic::LatticeToSurfaces(PhantomOnTheLattice(), requests, Mode::Lean, {});
  ASSERT_EQ(together.size(), texts.size());
  for (std::size_t n = 0; n < texts.size(); ++n)
  {
    EXPECT_EQ(together[n].name, requests[n].name);
    EXPECT_TRUE(together[n].surface->GetPoints() == Extract(texts[n])->GetPoints());
    EXPECT_TRUE(together[n].surface->GetTriangles() == Extract(texts[n])->GetTriangles());
  }
}

TEST(PhantomSurfaces, RequestsOnOneSideShareAPass)
{
  std::vector<SurfaceRequest> requests;
  for (const char * const text : { "skin=-485.5", "lungs=<-400.5", "bone=375.5" })
  {
    requests.push_back(rhombic::ParseSurfaceRequest(text, 0));
  }
  std::vector<std::string> steps;
  double last = 0.0;
  rhombic::Events events;
  events.progress = [&](const std::string & step, double fraction) {
    if (steps.empty() || steps.back() != step)
    {
      steps.push_back(step);
    }
    last = fraction;
  };
  rhombic::LatticeToSurfaces(PhantomOnTheLattice(), requests, Mode::Lean, events);
  EXPECT_EQ(steps, (std::vector<std::string>{ "extracting skin, bone", "extracting lungs" }));
  EXPECT_EQ(last, 1.0);
}

TEST(PhantomSurfaces, SamplesThatAreNotANumberAreNotedOnce)
{
  const auto image = itk::FCCImage<float>::New();
  image->SetRegions(itk::Size<3>{ { 8, 16, 16 } });
  image->Allocate();
  image->FillBuffer(0.0f);
  image->SetPixel({ { 4, 8, 8 } }, 2.0f);
  image->SetPixel({ { 1, 2, 3 } }, std::numeric_limits<float>::quiet_NaN());
  image->SetPixel({ { 5, 6, 7 } }, std::numeric_limits<float>::quiet_NaN());
  std::vector<std::string> notes;
  rhombic::Events events;
  events.note = [&notes](const std::string & line) { notes.push_back(line); };
  const std::vector<SurfaceRequest> requests{ rhombic::ParseSurfaceRequest("spot=1", 0),
                                              rhombic::ParseSurfaceRequest("rest=<1", 1) };
  rhombic::LatticeToSurfaces(image, requests, Mode::Lean, events);
  ASSERT_EQ(notes.size(), 3u);
  EXPECT_EQ(notes.front(), "2 samples are not a number and count as outside");
}

TEST(PhantomSurfaces, AnIsovalueThatIsNotKnownIsRefused)
{
  const std::vector<SurfaceRequest> requests{ rhombic::ParseSurfaceRequest("skin=-485.5", 0),
                                              rhombic::ParseSurfaceRequest("bone=otsu", 1) };
  try
  {
    rhombic::LatticeToSurfaces(PhantomOnTheLattice(), requests, Mode::Lean, {});
    FAIL();
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Usage);
    EXPECT_STREQ(failure.GetDescription(),
                 "The isovalue of bone is not known; give a number, or call ResolveIsovalues().");
  }
}

TEST(PhantomSurfaces, TheNestedLatticeAndLanczosHoldTheSameBody)
{
  rhombic::LatticeSettings nested;
  nested.nested = true;
  rhombic::LatticeSettings lanczos;
  lanczos.kernel = itk::SeparableKernel::Lanczos4;
  for (const auto & settings : { nested, lanczos })
  {
    const auto volume = rhombic::ScanToLattice(PhantomScan(), settings, {});
    const auto skin =
      rhombic::LatticeToSurfaces(volume, { rhombic::ParseSurfaceRequest("skin=-485.5", 0) }, Mode::Lean, {});
    EXPECT_NEAR(
      ComputeTriangleSurfaceVolume(*skin.front().surface) / rhombic::PhantomEnclosedBy(-485.5).volume, 1.0, 0.01);
  }
}

TEST(PhantomSurfaces, TheEnclosedAirIsTheLungsAndTheAirway)
{
  double exact = 0.0;
  for (const auto & organ : rhombic::PhantomOrgans())
  {
    exact += organ.hounsfield < -500.0 ? organ.volume : 0.0;
  }
  const auto lungs = Extract("lungs=<-400.5", SurfaceRequest::Parts::Enclosed);
  EXPECT_TRUE(ComputeTriangleSurfaceTopology(*lungs).IsWatertight());
  EXPECT_NEAR(ComputeTriangleSurfaceVolume(*lungs) / exact, 1.0, 0.02);
}

TEST(PhantomSurfaces, TheMarkerIsOnThePatientsLeftInFront)
{
  const auto marker = Extract("marker=1800.5");
  EXPECT_GT(CentroidX(*marker), 20.0) << "LPS: left is +x";
  const auto bounds = marker->GetBounds();
  const auto skin = Extract("skin=-485.5")->GetBounds();
  EXPECT_LT(bounds[3], (skin[2] + skin[3]) / 2) << "LPS: the front is -y";
}

} // namespace
