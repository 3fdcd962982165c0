#include "itkFilterDescriptions.h"

#include "itkMultiThreaderBase.h"
#include "itkRefusal.h"

namespace
{

using namespace filtertest;

template <typename TDescription>
class SurfaceFilterConformance : public testing::Test
{};
TYPED_TEST_SUITE(SurfaceFilterConformance, SurfaceFilters, FilterNames);

TYPED_TEST(SurfaceFilterConformance, HasTheSameOutputForAnyNumberOfThreads)
{
  const auto usual = itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads();
  const auto example = MakeExample<TypeParam>(1, { { 40, 48, 56 } });
  const std::string expected = MakeOutput(example);
  EXPECT_FALSE(expected == Snapshot(*example.input)) << "a test of nothing";
  for (const itk::ThreadIdType threads : { 1, 2, 5 })
  {
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
    EXPECT_TRUE(MakeOutput(example) == expected) << threads;
  }
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(usual);
}

TYPED_TEST(SurfaceFilterConformance, RefusesATriangleOfAMissingPoint)
{
  const auto example = MakeExample<TypeParam>(2);
  const auto filter = example.makeFilter();
  filter->SetInput(example.input);
  const std::string expected = UpdatedOutput(*filter);
  const auto triangle = example.input->GetTriangles().back();
  example.input->GetTriangles().back()[1] = static_cast<std::uint32_t>(example.input->GetNumberOfPoints());
  example.input->Modified();
  EXPECT_NE(Refusal([&] { filter->Update(); }), "");
  example.input->GetTriangles().back() = triangle;
  example.input->Modified();
  EXPECT_TRUE(UpdatedOutput(*filter) == expected);
}

TYPED_TEST(SurfaceFilterConformance, RefusesAnInputThatWasReleased)
{
  const auto example = MakeExample<TypeParam>(3);
  const auto filter = example.makeFilter();
  filter->SetInput(example.input);
  example.input->ReleaseDataFlagOn();
  EXPECT_EQ(Refusal([&] { filter->Update(); }), "");
  filter->Modified();
  const std::string refusal = Refusal([&] { filter->Update(); });
  EXPECT_NE(refusal.find("turn its ReleaseDataFlag off"), std::string::npos) << refusal;
}

TYPED_TEST(SurfaceFilterConformance, MakesNothingOfNothing)
{
  const auto filter = MakeExample<TypeParam>(4).makeFilter();
  filter->SetInput(itk::TriangleSurface::New());
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfTriangles(), 0u);
}

TYPED_TEST(SurfaceFilterConformance, WorksBehindAnotherFilter)
{
  Random random(5);
  const auto input = FCCIsosurface::MakeInput({ { 20, 20, 20 } }, random);
  const auto extract = FCCIsosurface::Filter::New();
  extract->SetInput(input);
  extract->SetMode(itk::FCCIsosurfaceMode::Tetrahedra); // sound, for simplification
  const auto filter = MakeExample<TypeParam>(6).makeFilter();
  filter->SetInput(extract->GetOutput());
  filter->Update();
  const auto first = filter->GetOutput()->GetNumberOfTriangles();
  extract->SetIsovalue(120.0);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfTriangles(), 0u);
  EXPECT_NE(filter->GetOutput()->GetNumberOfTriangles(), first);
}

TEST(SurfaceFilters, DoWhatTheirFunctionsDo)
{
  Random random(7);
  const auto input = SurfaceSimplification::MakeInput({ { 40, 40, 40 } }, random);
  const auto changed = [&input](const auto & change) {
    const auto surface = itk::TriangleSurface::New();
    surface->Graft(input);
    change(*surface);
    return Snapshot(*surface);
  };
  const auto simplify = itk::TriangleSurfaceSimplificationFilter::New();
  simplify->SetInput(input);
  simplify->SetTargetTriangles(3'000);
  EXPECT_TRUE(UpdatedOutput(*simplify) == changed([](auto & surface) { SimplifyTriangleSurface(surface, { 3'000 }); }));
  EXPECT_EQ(simplify->GetReport().trianglesAfter, simplify->GetOutput()->GetNumberOfTriangles());
  EXPECT_LE(simplify->GetOutput()->GetNumberOfTriangles(), 3'000u);

  const auto smooth = itk::TriangleSurfaceSmoothingFilter::New();
  smooth->SetInput(input);
  smooth->SetMaximumMove(0.1);
  EXPECT_TRUE(UpdatedOutput(*smooth) == changed([](auto & surface) { SmoothTriangleSurface(surface, { 20, 0.1 }); }));
  EXPECT_GT(smooth->GetReport().largestMove, 0.0);

  const auto finish = itk::TriangleSurfaceFinishFilter::New();
  finish->SetInput(input);
  finish->SetSpacing(0.7);
  finish->SetSmoothing(0.3);
  finish->SetMaximumTriangles(3'000);
  finish->KeepLargestPartOn();
  EXPECT_TRUE(UpdatedOutput(*finish) == changed([](auto & surface) {
                rhombic::SurfaceFinish steps;
                steps.smoothing = 0.3;
                steps.maximumTriangles = 3'000;
                steps.keepsLargestPart = true;
                RemoveParts(surface, steps, "surface", {});
                RefineSurface(surface, steps, 0.7, "surface", {});
              }));
  EXPECT_EQ(finish->GetRemoval().removed.solids, 1u);
  EXPECT_TRUE(finish->GetRefinement().simplification);
  EXPECT_EQ(finish->GetNotes().size(), 3u) << "parts, smoothing, simplification";
}

} // namespace
