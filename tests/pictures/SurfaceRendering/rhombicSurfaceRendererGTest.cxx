#include "rhombicFailure.h"
#include "rhombicTestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include <malloc.h>
#include <unistd.h>

namespace
{

using namespace rhombic;
using namespace rhombic::test;

/** First and last column and row that are not the (black) background. */
struct Box
{
  int left = 1 << 20;
  int right = -1;
  int top = 1 << 20;
  int bottom = -1;
};

Box
DrawnBox(const Picture & picture)
{
  Box box;
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      const auto * const pixel = picture.At(x, y);
      if (pixel[0] + pixel[1] + pixel[2] > 24)
      {
        box.left = std::min(box.left, x);
        box.right = std::max(box.right, x);
        box.top = std::min(box.top, y);
        box.bottom = std::max(box.bottom, y);
      }
    }
  }
  return box;
}

/** Mean position, from -1 (left, bottom) to 1 (right, top), of the pixels in which \a channel dominates. */
std::array<double, 2>
CentreOf(const Picture & picture, int channel)
{
  double sumX = 0.0;
  double sumY = 0.0;
  int count = 0;
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      const auto * const pixel = picture.At(x, y);
      const int others = std::max(pixel[(channel + 1) % 3], pixel[(channel + 2) % 3]);
      if (pixel[channel] > 60 && pixel[channel] > 2 * others)
      {
        sumX += x + 0.5;
        sumY += y + 0.5;
        ++count;
      }
    }
  }
  EXPECT_GT(count, 50);
  return { 2.0 * sumX / count / picture.width - 1.0, 1.0 - 2.0 * sumY / count / picture.height };
}

std::uint64_t
HashOf(const Picture & picture)
{
  std::uint64_t hash = 14695981039346656037ULL;
  for (const auto byte : picture.pixels)
  {
    hash = (hash ^ byte) * 1099511628211ULL;
  }
  return hash;
}

/** A translucent and an opaque surface with every effect on. */
Picture
DrawEverything()
{
  RenderSettings settings;
  settings.width = 240;
  settings.height = 200;
  SurfaceRenderer renderer;
  return Draw(renderer,
              { Item(Sphere({ 0, 0, 0 }, 50), Red, 0.3),
                Item(Sphere({ 10, 0, 5 }, 25), Green),
                Item(Sphere({ 20, -15, 15 }, 20), Blue, 0.5) },
              settings);
}

class SurfaceRendererTest : public testing::Test
{
protected:
  static void
  SetUpTestSuite()
  {
    unsetenv("DISPLAY");
  }
};

using SurfaceRendererBackend = SurfaceRendererTest;

TEST_F(SurfaceRendererBackend, DrawsWithoutADisplay)
{
  const SurfaceRenderer renderer;
  EXPECT_NE(renderer.GetBackendDescription().find("EGL"), std::string::npos);
  EXPECT_NE(renderer.GetBackendDescription().find("OpenGL"), std::string::npos);
}

TEST_F(SurfaceRendererBackend, ProbesTellWhatWorksAndWhyNot)
{
  const auto probes = SurfaceRenderer::ProbeBackends();
  ASSERT_EQ(probes.size(), 2u);
  EXPECT_TRUE(probes[0].usable || probes[1].usable);
  for (const auto & probe : probes)
  {
    EXPECT_FALSE(probe.name.empty());
    EXPECT_FALSE(probe.detail.empty());
  }
}

TEST_F(SurfaceRendererBackend, MissingBackendNamesThePackages)
{
  if (SurfaceRenderer::ProbeBackends()[0].usable)
  {
    GTEST_SKIP() << "there is a graphics card";
  }
  try
  {
    SurfaceRenderer{ RenderBackend::Device };
    FAIL() << "there is no graphics card";
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), FailureKind::Display);
    EXPECT_NE(std::string(failure.GetDescription()).find("libegl1"), std::string::npos);
  }
}

TEST_F(SurfaceRendererTest, EveryViewShowsEachSideWhereItBelongs)
{
  // Red to the patient's left, green to the back, blue to the head, each alone visible where the view says.
  const std::vector<SceneSurface> scene{ Item(Sphere({ 60, 0, 0 }, 12), Red),
                                         Item(Sphere({ 0, 60, 0 }, 12), Green),
                                         Item(Sphere({ 0, 0, 60 }, 12), Blue),
                                         Item(Sphere({ -60, -60, -60 }, 6), { 1, 1, 1 }) };
  SurfaceRenderer renderer;
  for (const bool perspective : { false, true })
  {
    for (const View & view : StandardViews())
    {
      SCOPED_TRACE(view.name);
      auto settings = Small();
      settings.perspective = perspective;
      const auto picture = Draw(renderer, scene, settings, view);
      const auto & frame = view.frame;
      for (int axis = 0; axis < 3; ++axis)
      {
        const auto centre = CentreOf(picture, axis);
        const std::array<double, 2> side{ frame.right[axis], frame.up[axis] };
        for (int k = 0; k < 2; ++k)
        {
          if (side[k] != 0)
          {
            EXPECT_GT(side[k] * centre[k], 0.2);
          }
        }
      }
    }
  }
}

TEST_F(SurfaceRendererTest, AnteriorViewHasThePatientsLeftAtTheRight)
{
  SurfaceRenderer renderer;
  const auto picture =
    Draw(renderer, { Item(Sphere({ 40, 0, 0 }, 15), Red), Item(Sphere({ -40, 0, 0 }, 15), Blue) }, Small());
  EXPECT_GT(CentreOf(picture, 0)[0], 0.3);
  EXPECT_LT(CentreOf(picture, 2)[0], -0.3);
}

TEST_F(SurfaceRendererTest, NearSurfaceHidesTheFarOne)
{
  SurfaceRenderer renderer;
  const auto front = Item(Sphere({ 0, -40, 0 }, 20), Red);
  const auto back = Item(Sphere({ 0, 40, 0 }, 15), Blue);
  const auto isRed = [](const Picture & picture) {
    const auto * const pixel = picture.At(picture.width / 2, picture.height / 2);
    return pixel[0] > pixel[2];
  };
  EXPECT_TRUE(isRed(Draw(renderer, { front, back }, Small())));
  EXPECT_FALSE(isRed(Draw(renderer, { front, back }, Small(), ViewFromText("posterior"))));
}

TEST_F(SurfaceRendererTest, SceneFillsThePictureUpToTheMargin)
{
  SurfaceRenderer renderer;
  // 0.02 of the shorter side: 3.2 pixels of 160; the sphere spans the height.
  for (const bool perspective : { false, true })
  {
    auto settings = Small();
    settings.perspective = perspective;
    const auto box = DrawnBox(Draw(renderer, { Item(Sphere({ 500, -300, 80 }, 30), Red) }, settings));
    EXPECT_NEAR(box.top, 3, 1);
    EXPECT_NEAR(box.bottom, 156, 1);
    EXPECT_NEAR(box.left + box.right, 199, 2);
    EXPECT_NEAR(box.right - box.left, box.bottom - box.top, 2);
  }
}

TEST_F(SurfaceRendererTest, WideSceneTouchesTheSideMargins)
{
  SurfaceRenderer renderer;
  for (const bool perspective : { false, true })
  {
    auto settings = Small();
    settings.perspective = perspective;
    const auto box = DrawnBox(
      Draw(renderer, { Item(Sphere({ 90, 0, 0 }, 10), Red), Item(Sphere({ -90, 50, 0 }, 10), Red) }, settings));
    EXPECT_NEAR(box.left, 3, 1);
    EXPECT_NEAR(box.right, 196, 1);
    EXPECT_GT(box.top, 20);
  }
}

TEST_F(SurfaceRendererTest, FlatAndTinyScenesAreDrawn)
{
  auto triangle = itk::TriangleSurface::New();
  triangle->GetPoints() = { { 0, 0, 0 }, { 1e-3f, 0, 0 }, { 0, 0, 1e-3f } };
  triangle->GetTriangles() = { { 0, 1, 2 } };
  SurfaceRenderer renderer;
  const auto box = DrawnBox(Draw(renderer, { Item(triangle, Red) }, Small()));
  EXPECT_GT(box.bottom - box.top, 60);
}

TEST_F(SurfaceRendererTest, FacingSurfaceHasItsColour)
{
  SurfaceRenderer renderer;
  auto settings = Small();
  settings.background = { 0.2, 0.4, 0.6 };
  const auto picture = Draw(renderer, { Item(Sphere({ 0, 0, 0 }, 30), { 0.5, 0.4, 0.3 }) }, settings);
  const auto * const centre = picture.At(100, 80);
  EXPECT_NEAR(centre[0] / 255.0, 0.5, 0.12);
  EXPECT_NEAR(centre[1] / 255.0, 0.4, 0.12);
  EXPECT_NEAR(centre[2] / 255.0, 0.3, 0.12);
  const auto * const corner = picture.At(0, 0);
  EXPECT_EQ(corner[0], 51);
  EXPECT_EQ(corner[1], 102);
  EXPECT_EQ(corner[2], 153);
}

TEST_F(SurfaceRendererTest, NoPartIsBlackOrBurntOut)
{
  SurfaceRenderer renderer;
  auto settings = Small();
  settings.background = { 1, 1, 1 };
  const auto picture = Draw(renderer, { Item(Sphere({ 0, 0, 0 }, 30), { 0.8, 0.8, 0.8 }) }, settings);
  for (int x = 30; x < 170; ++x)
  {
    const auto * const pixel = picture.At(x, 80);
    EXPECT_GT(pixel[0], 30) << "column " << x;
  }
  EXPECT_LT(picture.At(100, 80)[0], 250);
}

TEST_F(SurfaceRendererTest, SurfaceWithoutNormalsIsFaceted)
{
  auto bare = itk::TriangleSurface::New();
  const auto sphere = Sphere({ 0, 0, 0 }, 30);
  bare->GetPoints() = sphere->GetPoints();
  bare->GetTriangles() = sphere->GetTriangles();
  SurfaceRenderer renderer;
  const auto smooth = Draw(renderer, { Item(sphere, Red) }, Small());
  const auto faceted = Draw(renderer, { Item(bare, Red) }, Small());
  EXPECT_NE(smooth.pixels, faceted.pixels);
  EXPECT_NEAR(faceted.At(100, 80)[0], smooth.At(100, 80)[0], 12);
}

TEST_F(SurfaceRendererTest, TranslucentSurfaceShowsTheOneInside)
{
  const auto skin = Item(Sphere({ 0, 0, 0 }, 50), Red, 0.4);
  const auto bone = Item(Sphere({ 0, 0, 0 }, 25), Blue);
  SurfaceRenderer renderer;
  const auto picture = Draw(renderer, { skin, bone }, Small());
  const auto * const centre = picture.At(100, 80);
  EXPECT_GT(centre[0], 60);
  EXPECT_GT(centre[2], 90);
  EXPECT_EQ(picture.pixels, Draw(renderer, { bone, skin }, Small()).pixels);
}

TEST_F(SurfaceRendererTest, TranslucentSurfaceMixesWithTheBackground)
{
  SurfaceRenderer renderer;
  auto settings = Small();
  settings.background = { 0.0, 0.4, 1.0 };
  const auto picture = Draw(renderer, { Item(Sphere({ 0, 0, 0 }, 50), { 0.8, 0.4, 0.0 }, 0.3) }, settings);
  const auto * const centre = picture.At(100, 80);
  EXPECT_NEAR(centre[0] / 255.0, 0.16 * 0.8, 0.02); // 0.16: of a wall that faces the viewer
  EXPECT_NEAR(centre[1] / 255.0, 0.4, 0.02);
  EXPECT_NEAR(centre[2] / 255.0, 0.84, 0.02);
}

TEST_F(SurfaceRendererTest, MeanOpacityOfASphereIsTheNamedOne)
{
  SurfaceRenderer renderer;
  auto settings = Small();
  settings.style = PictureStyle::Transparent;
  for (const double opacity : { 0.1, 0.3, 0.6, 0.9 })
  {
    const auto picture = Draw(renderer, { Item(Sphere({ 0, 0, 0 }, 50), Red, opacity) }, settings);
    const double radius = 0.48 * picture.height; // margins take 0.02 on each side
    double sum = 0.0;
    for (std::size_t n = 3; n < picture.pixels.size(); n += 4)
    {
      sum += picture.pixels[n] / 255.0;
    }
    EXPECT_NEAR(sum / (std::acos(-1.0) * radius * radius), opacity, 0.02) << opacity;
    EXPECT_NEAR(picture.At(100, 80)[3] / 255.0, std::max(0.5 * opacity, 1.2 * opacity - 0.2), 0.01) << opacity;
  }
}

TEST_F(SurfaceRendererTest, WhiteSurfacesKeepTheirRelief)
{
  SurfaceRenderer renderer;
  for (const PictureStyle style : { PictureStyle::Clinic, PictureStyle::Paper })
  {
    for (const bool isGlossy : { false, true })
    {
      auto settings = Small();
      settings.style = style;
      settings.background = { 0, 0, 0 };
      SceneSurface ball = Item(Sphere({ 0, 0, 0 }, 50), { 1, 1, 1 });
      ball.isGlossy = isGlossy;
      const auto picture = Draw(renderer, { ball }, settings);
      EXPECT_LT(*std::max_element(picture.pixels.begin(), picture.pixels.end()), 250);
    }
  }
}

TEST_F(SurfaceRendererTest, NestedTranslucentSurfacesAreInOrder)
{
  const auto outer = Item(Sphere({ 0, 0, 0 }, 50), Red, 0.5);
  const auto middle = Item(Sphere({ 0, 0, 0 }, 35), Green, 0.5);
  const auto inner = Item(Sphere({ 0, 0, 0 }, 20), Blue, 0.5);
  SurfaceRenderer renderer;
  const auto picture = Draw(renderer, { outer, middle, inner }, Small());
  EXPECT_EQ(picture.pixels, Draw(renderer, { inner, outer, middle }, Small()).pixels);
  const auto * const centre = picture.At(100, 80);
  EXPECT_GT(centre[0], centre[1]);
  EXPECT_GT(centre[1], centre[2]);
  EXPECT_GT(centre[2], 20);
}

TEST_F(SurfaceRendererTest, TranslucentSurfaceIsDenserAtItsOutline)
{
  SurfaceRenderer renderer;
  auto settings = Small();
  settings.background = { 1, 1, 1 };
  const auto picture = Draw(renderer, { Item(Sphere({ 0, 0, 0 }, 50), Red, 0.3) }, settings);
  const int leftmost = 100 - 74;
  EXPECT_LT(picture.At(leftmost, 80)[1], picture.At(100, 80)[1] - 30);
}

TEST_F(SurfaceRendererTest, NothingToDrawIsAFailure)
{
  SurfaceRenderer renderer;
  const auto empty = itk::TriangleSurface::New();
  EXPECT_EQ(KindThrownBy(renderer, Scene(), Small()), FailureKind::Empty);
  EXPECT_EQ(KindThrownBy(renderer, { { Item(empty, Red), Item(nullptr, Red) }, {}, {} }, Small()), FailureKind::Empty);
  const auto sphere = Item(Sphere({ 0, 0, 0 }, 50), Red);
  EXPECT_EQ(Draw(renderer, { Item(empty, Red), sphere }, Small()).pixels, Draw(renderer, { sphere }, Small()).pixels);
}

TEST_F(SurfaceRendererTest, SettingsOutOfRangeAreFailures)
{
  SurfaceRenderer renderer;
  const auto surface = Sphere({ 0, 0, 0 }, 50);
  const Scene scene{ { Item(surface, Red) }, {}, {} };
  EXPECT_EQ(KindThrownBy(renderer, { { Item(surface, Red, 0.0) }, {}, {} }, Small()), FailureKind::Usage);
  EXPECT_EQ(KindThrownBy(renderer, { { Item(surface, Red, std::nan("")) }, {}, {} }, Small()), FailureKind::Usage);
  EXPECT_EQ(KindThrownBy(renderer, { { Item(surface, { 0.0, 1.5, 0.0 }) }, {}, {} }, Small()), FailureKind::Usage);
  auto settings = Small();
  settings.width = -1;
  EXPECT_EQ(KindThrownBy(renderer, scene, settings), FailureKind::Usage);
  settings.width = 100000;
  EXPECT_EQ(KindThrownBy(renderer, scene, settings), FailureKind::Usage);
  settings = Small();
  settings.samples = 5;
  EXPECT_EQ(KindThrownBy(renderer, scene, settings), FailureKind::Usage);
}

TEST_F(SurfaceRendererTest, RenderersLiveSideBySide)
{
  const std::vector<SceneSurface> scene{ Item(Sphere({ 0, 0, 0 }, 50), Red, 0.5) };
  SurfaceRenderer first;
  const auto expected = Draw(first, scene, Small());
  {
    SurfaceRenderer second;
    EXPECT_EQ(Draw(second, scene, Small()).pixels, expected.pixels);
    EXPECT_EQ(Draw(first, scene, Small()).pixels, expected.pixels);
  }
  EXPECT_EQ(Draw(first, scene, Small()).pixels, expected.pixels);
}

TEST_F(SurfaceRendererTest, ThreadsHaveTheirOwnRenderers)
{
  const auto expected = DrawEverything();
  std::array<Picture, 2> pictures;
  std::array<std::thread, 2> threads;
  for (std::size_t i = 0; i < threads.size(); ++i)
  {
    threads[i] = std::thread([&picture = pictures[i]] { picture = DrawEverything(); });
  }
  for (auto & thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(pictures[0].pixels, expected.pixels);
  EXPECT_EQ(pictures[1].pixels, expected.pixels);
}

TEST_F(SurfaceRendererTest, PicturesDoNotDependOnTheOnesBefore)
{
  const std::vector<SceneSurface> scene{ Item(Sphere({ 0, 0, 0 }, 50), Red) };
  SurfaceRenderer renderer;
  const auto expected = Draw(renderer, scene, Small());
  auto other = Small();
  other.width = 333;
  other.samples = 3;
  other.perspective = true;
  other.background = { 1, 1, 1 };
  Draw(renderer, { Item(Sphere({ 10, 0, 0 }, 5), Blue, 0.3) }, other, ViewFromText("left"));
  EXPECT_EQ(Draw(renderer, scene, Small()).pixels, expected.pixels);
}

TEST_F(SurfaceRendererTest, NothingIsPrinted)
{
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  DrawEverything();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(SurfaceRendererTest, PictureBeyondTheMemoryAllowedIsAFailureThatNamesOneThatFits)
{
  SurfaceRenderer renderer;
  const Scene scene{ { Item(Sphere({ 0, 0, 0 }, 50), Red, 0.5) }, {}, {} };
  RenderSettings settings;
  settings.width = 4000;
  settings.height = 2000;
  settings.maximumMemory = 300 << 20;
  EXPECT_EQ(KindThrownBy(renderer, scene, settings), FailureKind::Memory);
  int width = 0;
  int height = 0;
  try
  {
    renderer.CheckSettings(settings, true);
    FAIL() << "nothing was thrown";
  }
  catch (const Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), FailureKind::Memory);
    const std::string sentence = failure.GetDescription();
    EXPECT_NE(sentence.find("300.0 MiB"), std::string::npos) << sentence;
    const auto place = sentence.find("at most ");
    ASSERT_NE(place, std::string::npos) << sentence;
    ASSERT_EQ(std::sscanf(sentence.c_str() + place, "at most %d x %d pixels", &width, &height), 2) << sentence;
  }
  EXPECT_NEAR(width, 2 * height, 2);
  settings.width = width + 20;
  settings.height = height + 10;
  EXPECT_THROW(renderer.CheckSettings(settings, true), Failure);
  EXPECT_NO_THROW(renderer.CheckSettings(settings)) << "it is opaque";
  settings.width = width;
  settings.height = height;
  EXPECT_NO_THROW(renderer.CheckSettings(settings, true));
  settings.maximumMemory = 1;
  EXPECT_THROW(renderer.CheckSettings(settings), Failure);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

/** A line of /proc/self/status, in bytes. */
std::uintmax_t
MemoryOfProcess(const std::string & name)
{
  std::ifstream file("/proc/self/status");
  std::string line;
  while (std::getline(file, line))
  {
    if (line.rfind(name + ':', 0) == 0)
    {
      return std::stoull(line.substr(name.size() + 1)) * 1024;
    }
  }
  ADD_FAILURE() << name << " is not known";
  return 0;
}

/** Bytes that the process has, without those that malloc() keeps for later. */
double
MemoryInUse()
{
  malloc_trim(0);
  return static_cast<double>(MemoryOfProcess("VmRSS"));
}

/** Resets VmHWM, the most memory that the process had. */
void
ForgetPeakMemory()
{
  std::ofstream("/proc/self/clear_refs") << 5;
}

TEST_F(SurfaceRendererTest, DrawingTakesTheMemoryThatIsCounted)
{
  // The first picture of a process loads libraries that the later ones find.
  constexpr double libraries = 110 << 20;
  SurfaceRenderer renderer;
  Draw(renderer, { Item(Sphere({ 0, 0, 0 }, 50), Red) }, Small());
  for (const double opacity : { 1.0, 0.3 })
  {
    for (const int side : { 512, 1024 })
    {
      SCOPED_TRACE(std::to_string(side) + " pixels, opacity " + std::to_string(opacity));
      const Scene scene{ { Item(Sphere({ 0, 0, 0 }, 50), Red, opacity), Item(Sphere({ 10, 0, 5 }, 25), Green) },
                         {},
                         {} };
      RenderSettings settings;
      settings.width = side;
      settings.height = side;
      const double before = MemoryInUse();
      ForgetPeakMemory();
      const Picture picture = Draw(renderer, scene, settings);
      const double peak = static_cast<double>(MemoryOfProcess("VmHWM")) - before;
      const double left = MemoryInUse() - before;
      const auto counted = static_cast<double>(SurfaceRenderer::EstimateMemory(scene, settings));
      EXPECT_LT(peak, counted);
      EXPECT_GT(peak, 0.8 * (counted - libraries));
      EXPECT_LT(left, 32 << 20) << "is still held";
    }
  }
}

#endif

constexpr const char * HashFileVariable = "RHOMBIC_TEST_HASH_FILE";

TEST_F(SurfaceRendererTest, SameBytesTwice)
{
  const auto picture = DrawEverything();
  EXPECT_EQ(picture.pixels, DrawEverything().pixels);
  if (const char * const file = std::getenv(HashFileVariable)) // set by the test below for another process
  {
    std::ofstream(file) << HashOf(picture);
  }
}

TEST_F(SurfaceRendererTest, SameBytesWithAnyNumberOfThreads)
{
  const std::string expected = std::to_string(HashOf(DrawEverything()));
  const std::string file = testing::TempDir() + "rhombic-picture-hash-" + std::to_string(getpid());
  const auto program = std::filesystem::read_symlink("/proc/self/exe").string();
  for (const std::string threads : { "0", "1", "2", "5" })
  {
    const std::string command = std::string(HashFileVariable) + "='" + file + "' LP_NUM_THREADS=" + threads + " '" +
                                program + "' --gtest_filter='*SameBytesTwice' >/dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::string hash;
    std::ifstream(file) >> hash;
    EXPECT_EQ(hash, expected) << threads << " threads";
  }
  std::filesystem::remove(file);
}

} // namespace
