#include "vtkRhombicHeadlessRenderWindow.h"

#include "rhombicStockScenes.h"

#include <gtest/gtest.h>

#include <vtkAutoInit.h>
#include <vtkCallbackCommand.h>
#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

VTK_MODULE_INIT(vtkRenderingFreeType)

namespace
{

using namespace rhombic;
using namespace rhombic::test;
using Window = vtkRhombicHeadlessRenderWindow;
using Bytes = std::vector<unsigned char>;

/** RGB. */
Bytes
Read(vtkRenderWindow * window, bool front = false)
{
  vtkNew<vtkUnsignedCharArray> pixels;
  const int * const size = window->GetSize();
  EXPECT_EQ(window->GetPixelData(0, 0, size[0] - 1, size[1] - 1, front, pixels, 0), VTK_OK);
  return { pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues() };
}

std::array<int, 3>
At(const Bytes & pixels, int x, int y, int width = StockWidth)
{
  const auto first = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  return { pixels[first], pixels[first + 1], pixels[first + 2] };
}

constexpr std::array<int, 3> BlueBackground{ 0, 0, 255 };

Bytes
DrawNew(const StockScene & scene)
{
  vtkNew<Window> window;
  DrawStockScene(window, scene);
  return Read(window);
}

/** How many pixels satisfy a condition on their colours. */
template <typename TIsCounted>
int
Count(const Bytes & pixels, const TIsCounted & isCounted)
{
  int count = 0;
  for (std::size_t n = 0; n < pixels.size(); n += 3)
  {
    count += isCounted(pixels[n], pixels[n + 1], pixels[n + 2]) ? 1 : 0;
  }
  return count;
}

/** The errors that an object reports while this is alive; none of them is printed. */
class Errors
{
public:
  explicit Errors(vtkObject * object)
  {
    m_Command->SetClientData(this);
    m_Command->SetCallback([](vtkObject *, unsigned long, void * errors, void * text) {
      static_cast<Errors *>(errors)->m_Texts.emplace_back(static_cast<const char *>(text));
    });
    object->AddObserver(vtkCommand::ErrorEvent, m_Command);
  }

  std::vector<std::string> m_Texts;

private:
  const vtkNew<vtkCallbackCommand> m_Command;
};

std::size_t
ResidentBytes()
{
  std::ifstream file("/proc/self/statm");
  std::size_t all = 0;
  std::size_t resident = 0;
  file >> all >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

TEST(HeadlessRenderWindow, DrawsABallWhereItIs)
{
  const Bytes pixels = DrawNew(StockScenes[0]);
  EXPECT_EQ(At(pixels, 0, 0), BlueBackground);
  const auto centre = At(pixels, StockWidth / 2, StockHeight / 2);
  EXPECT_GT(centre[0], 200);
  EXPECT_LT(centre[2], 200);
  // Its outline is at 10 / sqrt(10^2 - 1) in the plane of focus, where half the picture's height is 10 tan(10 degrees).
  const double halfHeight = 10.0 * std::tan(10.0 * std::acos(-1.0) / 180.0);
  const double outline = 10.0 / std::sqrt(99.0) / halfHeight * 0.5 * StockHeight;
  int highest = 0;
  for (int y = 0; y < StockHeight; ++y)
  {
    highest = At(pixels, StockWidth / 2, y)[0] > 20 ? y : highest;
  }
  EXPECT_NEAR(highest + 0.5 - 0.5 * StockHeight, outline, 1.0);
  const int green = Count(pixels, [](int, int other, int) { return other > 100; });
  EXPECT_GT(green, 200);
}

TEST(HeadlessRenderWindow, PeelsSixTranslucentLayers)
{
  const Bytes pixels = DrawNew(StockScenes[1]);
  const auto centre = At(pixels, StockWidth / 2, StockHeight / 2);
  EXPECT_NEAR(centre[0], 255.0 * (1.0 - std::pow(0.5, 6)), 2.0);
  EXPECT_NEAR(centre[2], 255.0 * std::pow(0.5, 6), 2.0);
  EXPECT_EQ(At(pixels, 1, 1), BlueBackground);
}

TEST(HeadlessRenderWindow, DarkensWhereBallsMeet)
{
  StockScene without{ "balls", [](vtkRenderWindow * window, vtkRenderer * renderer) {
                       AddOccludedBalls(window, renderer);
                       static_cast<vtkOpenGLRenderer *>(renderer)->SetPass(nullptr);
                     } };
  const Bytes shaded = DrawNew(StockScenes[2]);
  const Bytes plain = DrawNew(without);
  int darker = 0;
  for (std::size_t n = 0; n < plain.size(); n += 3)
  {
    darker += shaded[n] + 20 < plain[n] ? 1 : 0;
  }
  EXPECT_GT(darker, 100);
}

TEST(HeadlessRenderWindow, DrawsText)
{
  const Bytes pixels = DrawNew(StockScenes[3]);
  const int yellow = Count(pixels, [](int red, int green, int blue) { return red > 200 && green > 200 && blue < 60; });
  EXPECT_GT(yellow, 300);
  EXPECT_LT(yellow, 3000);
  EXPECT_EQ(At(pixels, 5, 5), BlueBackground);
  EXPECT_EQ(At(pixels, 100, 150), BlueBackground);
}

TEST(HeadlessRenderWindow, DrawsAnImageSliceInItsGreys)
{
  const Bytes pixels = DrawNew(StockScenes[4]);
  vtkNew<vtkRTAnalyticSource> wavelet;
  wavelet->SetWholeExtent(-10, 10, -10, 10, -10, 10);
  wavelet->Update();
  const double value = wavelet->GetOutput()->GetScalarComponentAsDouble(0, 0, 0, 0);
  const double grey = 255.0 * std::min((value - 40.0) / 240.0, 1.0);
  const auto centre = At(pixels, StockWidth / 2, StockHeight / 2);
  EXPECT_NEAR(centre[0], grey, 5.0);
  EXPECT_EQ(centre[0], centre[1]);
  EXPECT_EQ(centre[0], centre[2]);
}

TEST(HeadlessRenderWindow, DrawsAScalarBarInItsColours)
{
  const Bytes pixels = DrawNew(StockScenes[5]);
  EXPECT_GT(Count(pixels, [](int red, int green, int blue) { return red > 240 && green < 40 && blue < 40; }), 20);
  EXPECT_GT(Count(pixels, [](int red, int green, int blue) { return green > 240 && red < 60 && blue < 40; }), 20);
}

TEST(HeadlessRenderWindow, GivesTheSamePixelsByEveryMethod)
{
  vtkNew<Window> window;
  window->SetMultiSamples(0); // VTK takes the mean of samples in two ways, which are rounded differently
  DrawStockScene(window, StockScenes[0]);
  const Bytes pixels = Read(window);
  EXPECT_EQ(Read(window, true), pixels);
  vtkNew<vtkUnsignedCharArray> rgba;
  ASSERT_EQ(window->GetRGBACharPixelData(0, 0, StockWidth - 1, StockHeight - 1, 0, rgba), VTK_OK);
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(window);
  filter->Update();
  auto * const image = vtkUnsignedCharArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetScalars());
  ASSERT_EQ(image->GetNumberOfValues(), static_cast<vtkIdType>(pixels.size()));
  for (std::size_t n = 0; n < pixels.size(); ++n)
  {
    ASSERT_EQ(rgba->GetValue(static_cast<vtkIdType>(n / 3 * 4 + n % 3)), pixels[n]) << n;
    ASSERT_EQ(image->GetValue(static_cast<vtkIdType>(n)), pixels[n]) << n;
  }
}

TEST(HeadlessRenderWindow, GivesDepths)
{
  vtkNew<Window> window;
  const auto renderer = DrawStockScene(window, StockScenes[1]);
  renderer->RemoveAllViewProps();
  renderer->AddActor(MakeBall(1.0, 1.0));
  renderer->GetActiveCamera()->SetClippingRange(5.0, 20.0);
  window->Render();
  vtkNew<vtkFloatArray> depths;
  ASSERT_EQ(window->GetZbufferData(0, 0, StockWidth - 1, StockHeight - 1, depths), VTK_OK);
  EXPECT_EQ(depths->GetValue(0), 1.0f);
  // The nearest point of the ball is at the distance 9; its neighbours in the picture are a little farther.
  const double nearest = (1.0 / 5.0 - 1.0 / 9.0) / (1.0 / 5.0 - 1.0 / 20.0);
  EXPECT_NEAR(depths->GetValue((StockHeight / 2) * StockWidth + StockWidth / 2), nearest, 2e-4);
}

TEST(HeadlessRenderWindow, SmoothsEdgesByMultisamples)
{
  const auto mixedPixels = [](int samples) {
    vtkNew<Window> window;
    window->SetMultiSamples(samples);
    const auto renderer = DrawStockScene(window, StockScenes[0]);
    renderer->RemoveAllViewProps();
    const auto ball = MakeBall(1.0, 1.0);
    ball->GetProperty()->LightingOff();
    renderer->AddActor(ball);
    window->Render();
    return Count(Read(window), [](int red, int, int) { return red > 0 && red < 255; });
  };
  EXPECT_EQ(mixedPixels(0), 0);
  EXPECT_GT(mixedPixels(4), 50);
}

TEST(HeadlessRenderWindow, HasAnAlphaPlane)
{
  vtkNew<Window> window;
  window->SetMultiSamples(0);
  const auto renderer = DrawStockScene(window, StockScenes[0]);
  EXPECT_EQ(window->GetAlphaBitPlanes(), 8);
  renderer->SetBackgroundAlpha(0.0);
  window->Render();
  vtkNew<vtkUnsignedCharArray> rgba;
  window->GetRGBACharPixelData(0, 0, StockWidth - 1, StockHeight - 1, 0, rgba);
  EXPECT_EQ(rgba->GetValue(3), 0);
  EXPECT_EQ(rgba->GetValue(4 * ((StockHeight / 2) * StockWidth + StockWidth / 2) + 3), 255);
}

TEST(HeadlessRenderWindow, AHundredWindowsLeaveNoMemory)
{
  const auto drawAll = [](int windows) {
    for (int n = 0; n < windows; ++n)
    {
      DrawNew(StockScenes[static_cast<std::size_t>(n) % StockScenes.size()]);
    }
  };
  drawAll(24);
  const std::size_t before = ResidentBytes();
  drawAll(100);
  const std::size_t after = ResidentBytes();
  RecordProperty("growth", std::to_string(static_cast<long>(after) - static_cast<long>(before)));
  // One window of 200 x 160 pixels with 4 samples takes about 2 MB.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which keep all memory for themselves
  EXPECT_LT(after, before + 4'000'000) << (static_cast<double>(after) - static_cast<double>(before)) / 100.0
                                       << " bytes for each window";
#endif
}

TEST(HeadlessRenderWindow, TwoDrawInTurn)
{
  const Bytes ball = DrawNew(StockScenes[0]);
  const Bytes text = DrawNew(StockScenes[3]);
  vtkNew<Window> first;
  vtkNew<Window> second;
  DrawStockScene(first, StockScenes[0]);
  DrawStockScene(second, StockScenes[3]);
  for (int turn = 0; turn < 3; ++turn)
  {
    EXPECT_EQ(Read(first), ball);
    EXPECT_EQ(Read(second), text);
    first->Render();
    EXPECT_TRUE(first->IsCurrent());
    EXPECT_FALSE(second->IsCurrent());
    second->Render();
  }
}

TEST(HeadlessRenderWindow, DrawsInAnotherSizeAsANewWindowDoes)
{
  vtkNew<Window> window;
  DrawStockScene(window, StockScenes[0]);
  for (const std::array<int, 2> size : { std::array<int, 2>{ 500, 300 }, { 33, 77 }, { StockWidth, StockHeight } })
  {
    window->SetSize(size[0], size[1]);
    window->Render();
    vtkNew<Window> other;
    DrawStockScene(other, StockScenes[0]);
    other->SetSize(size[0], size[1]);
    other->Finalize();
    other->Render();
    EXPECT_EQ(Read(window), Read(other)) << size[0] << " x " << size[1];
    EXPECT_EQ(Read(window).size(), static_cast<std::size_t>(3 * size[0] * size[1]));
  }
  EXPECT_EQ(Read(window), DrawNew(StockScenes[0]));
}

TEST(HeadlessRenderWindow, DrawsAgainAfterFinalizing)
{
  vtkNew<Window> window;
  DrawStockScene(window, StockScenes[0]);
  const Bytes pixels = Read(window);
  window->Finalize();
  EXPECT_EQ(window->GetGenericContext(), nullptr);
  EXPECT_FALSE(window->IsCurrent());
  window->Finalize();
  window->Render();
  EXPECT_NE(window->GetGenericContext(), nullptr);
  EXPECT_EQ(Read(window), pixels);
  window->ReleaseGraphicsResources(window);
  window->Render();
  EXPECT_EQ(Read(window), pixels);
}

TEST(HeadlessRenderWindow, IsDeletedInAnyOrder)
{
  const Bytes pixels = DrawNew(StockScenes[0]);
  for (const bool firstGoesFirst : { true, false })
  {
    auto first = vtkSmartPointer<Window>::New();
    auto second = vtkSmartPointer<Window>::New();
    auto renderer = DrawStockScene(first, StockScenes[0]);
    DrawStockScene(second, StockScenes[3]);
    (firstGoesFirst ? first : second) = nullptr;
    if (firstGoesFirst)
    {
      // The renderer outlives its window and goes to another one.
      EXPECT_EQ(renderer->GetRenderWindow(), nullptr);
      auto third = vtkSmartPointer<Window>::New();
      third->SetSize(StockWidth, StockHeight);
      third->AddRenderer(renderer);
      third->Render();
      EXPECT_EQ(Read(third), pixels);
      second->Render();
      renderer = nullptr;
      third->Render();
    }
    else
    {
      first->Render();
      EXPECT_EQ(Read(first), pixels);
      first->RemoveRenderer(renderer);
      first = nullptr;
    }
  }
  const vtkNew<Window> neverUsed;
}

TEST(HeadlessRenderWindow, DrawsOnOneThreadAfterTheOther)
{
  const Bytes expected = DrawNew(StockScenes[0]);
  vtkNew<Window> window;
  DrawStockScene(window, StockScenes[0]);
  window->ReleaseCurrent();
  EXPECT_FALSE(window->IsCurrent());
  Bytes pixels;
  std::thread([&] {
    window->Render();
    pixels = Read(window);
    window->ReleaseCurrent();
  }).join();
  EXPECT_EQ(pixels, expected);
  window->Render();
  EXPECT_EQ(Read(window), expected);
  // This thread keeps the context, so another one can't draw.
  const Errors errors(window);
  std::thread([&] {
    window->Render();
    vtkNew<vtkUnsignedCharArray> none;
    EXPECT_EQ(window->GetPixelData(0, 0, 9, 9, 0, none, 0), VTK_ERROR);
  }).join();
  ASSERT_EQ(errors.m_Texts.size(), 1u);
  EXPECT_NE(errors.m_Texts[0].find("call ReleaseCurrent() there"), std::string::npos) << errors.m_Texts[0];
  EXPECT_EQ(Read(window), expected);
}

TEST(HeadlessRenderWindow, TellsWhatItDrawsWith)
{
  vtkNew<Window> window;
  ASSERT_EQ(window->SupportsOpenGL(), 1);
  EXPECT_FALSE(window->IsCurrent()) << "nothing was current before";
  EXPECT_NE(window->GetOpenGLSupportMessage().find(", OpenGL "), std::string::npos);
  EXPECT_NE(window->GetGenericDisplayId(), nullptr);
  EXPECT_NE(window->GetGenericContext(), nullptr);
  EXPECT_NE(std::string(window->ReportCapabilities()).find("OpenGL version string"), std::string::npos);
  std::ostringstream text;
  window->Print(text);
  EXPECT_NE(text.str().find(window->GetOpenGLSupportMessage()), std::string::npos);
  for (const BackendProbe & probe : Window::ProbeBackends())
  {
    vtkNew<Window> other;
    other->SetBackend(probe.backend);
    EXPECT_EQ(other->SupportsOpenGL() == 1, probe.usable) << probe.name;
    EXPECT_NE(other->GetOpenGLSupportMessage().find(probe.name + (probe.usable ? ", " : ": ") + probe.detail),
              std::string::npos)
      << other->GetOpenGLSupportMessage();
  }
}

/** Uses a window in every way where EGL has no driver, and ends with the number of mistakes. */
[[noreturn]] void
DrawWithoutEGL()
{
  setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/dev/null", 1);
  int mistakes = 0;
  {
    vtkNew<Window> window;
    const Errors errors(window);
    mistakes += window->SupportsOpenGL() != 0;
    const std::string message = window->GetOpenGLSupportMessage();
    mistakes += message.find("There is no way to draw on this machine (") != 0;
    mistakes += message.find("install the Debian packages libegl1 and libgl1-mesa-dri.") == std::string::npos;
    mistakes += !errors.m_Texts.empty();
    DrawStockScene(window, StockScenes[0]);
    mistakes += errors.m_Texts.size() != 1 || errors.m_Texts[0].find(message) == std::string::npos;
    vtkNew<vtkUnsignedCharArray> pixels;
    vtkNew<vtkFloatArray> depths;
    mistakes += window->GetPixelData(0, 0, 9, 9, 1, pixels, 0) != VTK_ERROR;
    mistakes += window->GetRGBACharPixelData(0, 0, 9, 9, 1, pixels) != VTK_ERROR;
    mistakes += window->GetZbufferData(0, 0, 9, 9, depths) != VTK_ERROR;
    mistakes += window->ReportCapabilities() != message;
    vtkNew<vtkWindowToImageFilter> filter;
    filter->SetInput(window);
    filter->Update();
    mistakes += errors.m_Texts.size() != 2;
    window->MakeCurrent();
    mistakes += window->IsCurrent();
    window->PushContext();
    window->PopContext();
    window->ReleaseCurrent();
    window->Finalize();
    for (const BackendProbe & probe : Window::ProbeBackends())
    {
      mistakes += probe.usable || probe.detail.empty();
    }
  }
  std::exit(mistakes);
}

TEST(HeadlessRenderWindowDeathTest, WithoutEGLThereIsOneSentenceAndNothingIsPrinted)
{
  GTEST_FLAG_SET(death_test_style, "threadsafe"); // a new process, in which EGL has found no driver yet
  EXPECT_EXIT(DrawWithoutEGL(), testing::ExitedWithCode(0), testing::Eq(""));
}

} // namespace
