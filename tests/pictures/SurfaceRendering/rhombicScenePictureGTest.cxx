#include "rhombicTestScenes.h"

#include <algorithm>
#include <cstdlib>
#include <random>

namespace
{

using namespace rhombic;
using namespace rhombic::test;

class ScenePicture : public testing::Test
{
protected:
  static void
  SetUpTestSuite()
  {
    unsetenv("DISPLAY");
  }

  SurfaceRenderer m_Renderer;
};

/** A closed box without normals. */
itk::TriangleSurface::Pointer
Box(const Point & lowest, const Point & highest)
{
  auto surface = itk::TriangleSurface::New();
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    itk::TriangleSurface::PointType point;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      point[axis] = static_cast<float>((corner >> axis & 1U) != 0 ? highest[axis] : lowest[axis]);
    }
    surface->GetPoints().push_back(point);
  }
  surface->GetTriangles() = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 },
                              { 2, 6, 7 }, { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  return surface;
}

/** A surface over 81 x 81 points, 1 mm apart, seen from the front. Its normals are those of a plane. \param depthAt
 * called with x and z, -40 to 40 */
template <typename TDepthAt>
itk::TriangleSurface::Pointer
Relief(const TDepthAt & depthAt)
{
  constexpr int half = 40;
  constexpr std::uint32_t side = 2 * half + 1;
  auto surface = itk::TriangleSurface::New();
  for (int z = -half; z <= half; ++z)
  {
    for (int x = -half; x <= half; ++x)
    {
      surface->GetPoints().push_back(
        { static_cast<float>(x), static_cast<float>(depthAt(x, z)), static_cast<float>(z) });
      surface->GetNormals().push_back({ 0.0f, -1.0f, 0.0f });
      if (x < half && z < half)
      {
        const auto first = static_cast<std::uint32_t>(surface->GetNumberOfPoints() - 1);
        surface->GetTriangles().push_back({ first, first + 1, first + side + 1 });
        surface->GetTriangles().push_back({ first, first + side + 1, first + side });
      }
    }
  }
  return surface;
}

/** The same triangles, none of which share points. */
itk::TriangleSurface::Pointer
Separated(const itk::TriangleSurface * surface)
{
  auto separated = itk::TriangleSurface::New();
  for (const auto & triangle : surface->GetTriangles())
  {
    const auto first = static_cast<std::uint32_t>(separated->GetNumberOfPoints());
    for (const auto index : triangle)
    {
      separated->GetPoints().push_back(surface->GetPoints()[index]);
    }
    separated->GetTriangles().push_back({ first, first + 1, first + 2 });
  }
  return separated;
}

/** Position of the mean of all pixels, weighted by their difference from black. */
PicturePosition
CentreOfLight(const Picture & picture)
{
  double sum = 0.0;
  double sumX = 0.0;
  double sumY = 0.0;
  for (int y = 0; y < picture.height; ++y)
  {
    for (int x = 0; x < picture.width; ++x)
    {
      const auto * const pixel = picture.At(x, y);
      const double weight = std::max({ pixel[0], pixel[1], pixel[2] }) > 0 ? 1.0 : 0.0;
      sum += weight;
      sumX += weight * (x + 0.5);
      sumY += weight * (y + 0.5);
    }
  }
  EXPECT_GT(sum, 0.0);
  return { sumX / sum, sumY / sum };
}

/** The picture over a background. */
std::array<double, 3>
Over(const std::uint8_t * pixel, const Colour & background)
{
  std::array<double, 3> colour{};
  for (std::size_t channel = 0; channel < 3; ++channel)
  {
    const double alpha = pixel[3] / 255.0;
    colour[channel] = alpha * pixel[channel] + (1.0 - alpha) * 255.0 * background[channel];
  }
  return colour;
}

double
LargestDifference(const Picture & a, const Picture & b)
{
  EXPECT_EQ(a.pixels.size(), b.pixels.size());
  double largest = 0.0;
  for (std::size_t n = 0; n < a.pixels.size(); ++n)
  {
    largest = std::max(largest, static_cast<double>(std::abs(a.pixels[n] - b.pixels[n])));
  }
  return largest;
}

Picture
OneColour(int width, int height, const std::vector<std::uint8_t> & pixel)
{
  Picture picture(width, height, static_cast<int>(pixel.size()));
  for (std::size_t n = 0; n < picture.pixels.size(); ++n)
  {
    picture.pixels[n] = pixel[n % pixel.size()];
  }
  return picture;
}

// Cameras

TEST_F(ScenePicture, ProjectionTellsWherePointsAreSeen)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-80.0, 80.0);
  for (int trial = 0; trial < 12; ++trial)
  {
    const Point point{ place(random) + 100.0, place(random), place(random) - 300.0 };
    RenderSettings settings = Plain();
    settings.extent = LPSBox{ { 0, -100, -400 }, { 200, 100, -200 } };
    settings.margins = Margins{ 5, 31, 17, 2 };
    settings.zoom = trial % 2 == 0 ? 1.0 : 0.8;
    const View view = trial < 6 ? StandardViews()[static_cast<std::size_t>(trial)] : ObliqueView(place(random), 37.0);
    const auto rendered = m_Renderer.Render({ { Item(Sphere(point, 6.0), Red) }, {}, {} }, settings, { view }).front();
    ASSERT_TRUE(rendered.projection);
    EXPECT_EQ(rendered.projection->width, rendered.picture.width);
    EXPECT_EQ(rendered.projection->height, rendered.picture.height);
    const auto seen = CentreOfLight(rendered.picture);
    const auto expected = rendered.projection->PositionOf(point);
    EXPECT_NEAR(seen.x, expected.x, 0.35) << view.name;
    EXPECT_NEAR(seen.y, expected.y, 0.35) << view.name;
  }
}

TEST_F(ScenePicture, SphereHasItsDiameterInPixels)
{
  RenderSettings settings = Plain();
  settings.background = Colour{ 0, 0, 0 };
  settings.pixelSize = 0.5;
  const auto rendered =
    m_Renderer.Render({ { Item(Sphere({ 10, 20, 30 }, 30), { 1, 1, 1 }) }, {}, {} }, settings, { ObliqueView(20, 50) });
  EXPECT_DOUBLE_EQ(rendered.front().projection->pixelSize, 0.5);
  const Picture & picture = rendered.front().picture;
  int lit = 0;
  for (std::size_t n = 0; n < picture.pixels.size(); n += 3)
  {
    lit += picture.pixels[n] > 0;
  }
  const double radius = std::sqrt(lit / std::acos(-1.0));
  EXPECT_NEAR(radius, 60.0, 0.6);
}

TEST_F(ScenePicture, PictureFitsTheBodyWhenNoSizeIsGiven)
{
  const Scene scene{ { Item(Box({ 0, 0, 0 }, { 100, 50, 300 }), Red) }, {}, {} };
  RenderSettings settings = Plain();
  settings.margins = Margins{ 10, 20, 30, 40 };
  settings.width = 230;
  settings.height = 0;
  const auto standing = m_Renderer.Render(scene, settings, { ViewFromText("anterior"), ViewFromText("superior") });
  EXPECT_EQ(standing[0].picture.width, 230);
  EXPECT_EQ(standing[0].picture.height, 600 + 70);
  EXPECT_EQ(standing[1].picture.height, 100 + 70);
  settings.width = 0;
  const auto longer = m_Renderer.Render(scene, settings, { View() }).front();
  EXPECT_EQ(longer.picture.height, 1200);
  EXPECT_EQ(longer.picture.width, (1200 - 70) / 3 + 1 + 30);
  settings.pixelSize = 2.0;
  const auto scaled = m_Renderer.Render(scene, settings, { View() }).front();
  EXPECT_EQ(scaled.picture.width, 50 + 30);
  EXPECT_EQ(scaled.picture.height, 150 + 70);
}

TEST_F(ScenePicture, ViewsMayShareOneScale)
{
  const Scene scene{ { Item(Box({ 0, 0, 0 }, { 100, 50, 300 }), Red) }, {}, {} };
  RenderSettings settings = Plain();
  const std::vector<View> views{ ViewFromText("anterior"), ViewFromText("superior") };
  const auto own = m_Renderer.Render(scene, settings, views);
  EXPECT_LT(own[1].projection->pixelSize, own[0].projection->pixelSize);
  settings.sameScale = true;
  const auto shared = m_Renderer.Render(scene, settings, views);
  EXPECT_EQ(shared[0].projection->pixelSize, own[0].projection->pixelSize);
  EXPECT_EQ(shared[1].projection->pixelSize, own[0].projection->pixelSize);
}

TEST_F(ScenePicture, TurntableKeepsTheSceneInPlace)
{
  const Scene scene{
    { Item(Sphere({ 10, 50, 300 }, 40), Red), Item(Sphere({ 60, 20, 330 }, 10), Blue), Item(nullptr, Red) }, {}, {}
  };
  RenderSettings settings = Plain();
  settings.extent = BoxAround(scene.surfaces);
  settings.sameScale = true;
  std::vector<View> views;
  for (double azimuth = 0.0; azimuth < 360.0; azimuth += 45.0)
  {
    views.push_back(ObliqueView(azimuth, 10.0));
  }
  const Vector3 middle{ 20, 50, 300 }; // of x -30 to 70, y 10 to 90, z 260 to 340
  for (const RenderedView & rendered : m_Renderer.Render(scene, settings, views))
  {
    EXPECT_EQ(rendered.projection->pixelSize, m_Renderer.Render(scene, settings, views)[0].projection->pixelSize);
    EXPECT_NEAR(rendered.projection->PositionOf(middle).x, 100.0, 0.01);
    EXPECT_NEAR(rendered.projection->PositionOf(middle).y, 80.0, 0.01);
  }
  EXPECT_THROW(BoxAround({ Item(nullptr, Red) }), Failure);
}

TEST_F(ScenePicture, CentreAndZoomShowADetail)
{
  const Scene scene{ { Item(Sphere({ 0, 0, 0 }, 50), Red), Item(Sphere({ 40, -60, 20 }, 5), Green) }, {}, {} };
  RenderSettings settings = Plain();
  settings.margins = Margins{};
  settings.centre = Vector3{ 40, -60, 20 };
  settings.zoom = 8.0;
  const auto rendered = m_Renderer.Render(scene, settings, { View() }).front();
  const auto position = rendered.projection->PositionOf({ 40, -60, 20 });
  EXPECT_NEAR(position.x, 100.0, 1e-9);
  EXPECT_NEAR(position.y, 80.0, 1e-9);
  EXPECT_GT(rendered.picture.At(100, 80)[1], 100);
  settings.zoom = 1.0;
  settings.centre.reset();
  settings.extent = LPSBox{ { 36, -64, 16 }, { 44, -56, 24 } };
  const auto cropped = m_Renderer.Render(scene, settings, { View() }).front();
  EXPECT_NEAR(cropped.projection->pixelSize, 8.0 / 160.0, 1e-9);
  EXPECT_GT(cropped.picture.At(100, 80)[1], 100);
}

TEST_F(ScenePicture, PartsOutsideAreLeftOutWithoutATrace)
{
  // The middle of a large picture and a picture of the middle: the same samples.
  const Scene scene{ { Item(Sphere({ 0, 0, 0 }, 50), Red), Item(Sphere({ 5, -60, 9 }, 25), Blue, 0.4) }, {}, {} };
  RenderSettings settings = Plain();
  settings.margins = Margins{};
  settings.width = settings.height = 400;
  const Picture large = Draw(m_Renderer, scene, settings);
  settings.width = settings.height = 100;
  settings.zoom = 4.0;
  const Picture middle = Draw(m_Renderer, scene, settings);
  double sum = 0.0;
  for (int y = 0; y < 100; ++y)
  {
    for (int x = 0; x < 300; ++x)
    {
      sum += std::abs(middle.At(0, y)[x] - large.At(150, 150 + y)[x]);
    }
  }
  EXPECT_LT(sum / 30000.0, 0.05);
}

TEST_F(ScenePicture, SeveralViewsAreThoseDrawnAlone)
{
  const Scene scene{ { Item(Sphere({ 0, 0, 0 }, 50), Red, 0.4), Item(Sphere({ 5, -20, 9 }, 25), Blue) }, {}, {} };
  const std::vector<View> views{ View(), ObliqueView(30, 15), ViewFromText("superior") };
  RenderSettings settings = Small();
  settings.height = 0;
  const auto together = m_Renderer.Render(scene, settings, views);
  ASSERT_EQ(together.size(), views.size());
  for (std::size_t n = 0; n < views.size(); ++n)
  {
    EXPECT_EQ(together[n].picture.pixels, Draw(m_Renderer, scene, settings, views[n]).pixels) << views[n].name;
  }
  settings.perspective = true;
  EXPECT_FALSE(m_Renderer.Render(scene, settings, { View() }).front().projection);
}

// Translucent surfaces

TEST_F(ScenePicture, TranslucentSpheresAreBlendedInOrderAlongEveryRay)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 4; ++trial)
  {
    struct Ball
    {
      Point centre;
      double radius;
      Colour colour;
      double opacity;
      Picture lit;
    };
    std::vector<Ball> balls;
    std::vector<SceneSurface> surfaces;
    RenderSettings settings = Plain();
    settings.extent = LPSBox{ { -80, -80, -80 }, { 80, 80, 80 } };
    const auto projection = m_Renderer.Render({ { Item(Sphere({ 0, 0, 0 }, 50), Red) }, {}, {} }, settings, { View() })
                              .front()
                              .projection.value();
    for (int n = 0; n < 7; ++n)
    {
      Ball ball;
      // Nested in the first trial, anywhere in the others.
      const double reach = trial == 0 ? 0.0 : 30.0;
      ball.centre = { reach * (unit(random) - 0.5), reach * (unit(random) - 0.5), reach * (unit(random) - 0.5) };
      ball.radius = 70.0 - 8.0 * n;
      ball.colour = { unit(random), unit(random), unit(random) };
      ball.opacity = 0.1 + 0.6 * unit(random);
      const auto sphere = Sphere(ball.centre, ball.radius);
      ball.lit = Draw(m_Renderer, { Item(sphere, ball.colour) }, settings);
      surfaces.push_back(Item(sphere, ball.colour, ball.opacity));
      balls.push_back(ball);
    }
    std::shuffle(surfaces.begin(), surfaces.end(), random);
    const Picture picture = Draw(m_Renderer, surfaces, settings);
    int rays = 0;
    for (int ray = 0; ray < 400; ++ray)
    {
      const int x = static_cast<int>(200 * unit(random));
      const int y = static_cast<int>(160 * unit(random));
      const Vector3 point = projection.PointAt({ x + 0.5, y + 0.5 });
      struct Hit
      {
        double depth;
        double alpha;
        const std::uint8_t * colour;
      };
      std::vector<Hit> hits;
      bool isClear = true; // no outline near, and no two walls at nearly the same depth
      for (const Ball & ball : balls)
      {
        const double dx = point[0] - ball.centre[0];
        const double dz = point[2] - ball.centre[2];
        const double across = std::sqrt(dx * dx + dz * dz) / ball.radius;
        isClear = isClear && std::abs(across - 1.0) > 0.08;
        if (across < 1.0)
        {
          const double cosine = std::sqrt(1.0 - across * across);
          const double least = std::max(ball.opacity, 0.25);
          const double exponent = std::max(2.0, 0.5 * (std::sqrt(16.0 / least - 7.0) - 3.0));
          const double facing = std::max(0.5 * least, 1.2 * least - 0.2);
          hits.push_back({ ball.centre[1] - ball.radius * cosine,
                           ball.opacity / least * (facing + (1.0 - facing) * std::pow(1.0 - cosine, exponent)),
                           ball.lit.At(x, y) });
        }
      }
      std::sort(hits.begin(), hits.end(), [](const Hit & a, const Hit & b) { return a.depth > b.depth; });
      for (std::size_t n = 1; n < hits.size(); ++n)
      {
        isClear = isClear && hits[n - 1].depth - hits[n].depth > 0.5;
      }
      if (!isClear || hits.empty())
      {
        continue;
      }
      ++rays;
      std::array<double, 3> blended{};
      for (const Hit & hit : hits)
      {
        for (std::size_t channel = 0; channel < 3; ++channel)
        {
          blended[channel] = hit.alpha * hit.colour[channel] + (1.0 - hit.alpha) * blended[channel];
        }
      }
      for (std::size_t channel = 0; channel < 3; ++channel)
      {
        EXPECT_NEAR(picture.At(x, y)[channel], blended[channel], 2.0) << x << ", " << y;
      }
    }
    EXPECT_GT(rays, 30);
  }
}

TEST_F(ScenePicture, WallsBehindTheThirtySecondAreLeftOut)
{
  std::vector<SceneSurface> shells;
  for (int n = 0; n < 32; ++n)
  {
    shells.push_back(Item(Sphere({ 0, 0, 0 }, 50.0 - n), Red, 0.04));
  }
  const Picture thirtyTwo = Draw(m_Renderer, shells, Plain());
  EXPECT_GT(thirtyTwo.At(100, 80)[0], 50);
  shells.push_back(Item(Sphere({ 0, 0, 0 }, 10), Green, 0.5));
  EXPECT_EQ(Draw(m_Renderer, shells, Plain()).pixels, thirtyTwo.pixels);
}

TEST_F(ScenePicture, PartsOfLargePicturesFitTogether)
{
  // Six walls in 5.8 million samples are more fragments than are kept at once; the small picture has one part.
  RenderSettings settings = Plain();
  settings.pixelSize = 0.05;
  settings.centre = { 0, 0, 0 };
  std::vector<SceneSurface> shells;
  for (int n = 0; n < 6; ++n)
  {
    shells.push_back(Item(Sphere({ 0, 0, 0 }, 60.0 - 3.0 * n), n % 2 == 0 ? Red : Green, 0.3));
  }
  shells.push_back(Item(Sphere({ 0, 0, 5 }, 8), Blue));
  settings.width = settings.height = 1200;
  const Picture large = Draw(m_Renderer, shells, settings);
  settings.width = settings.height = 400;
  const Picture small = Draw(m_Renderer, shells, settings);
  int different = 0; // but for the rounding of the triangles' corners
  for (int y = 0; y < 400; ++y)
  {
    for (int x = 0; x < 400; ++x)
    {
      for (int channel = 0; channel < 3; ++channel)
      {
        different += std::abs(large.At(400 + x, 400 + y)[channel] - small.At(x, y)[channel]) > 1 ? 1 : 0;
      }
    }
  }
  EXPECT_LE(different, 50);
}

// Styles

TEST_F(ScenePicture, TransparentPictureIsRightOverAnyBackground)
{
  const Scene scene{ { Item(Sphere({ 0, 0, 0 }, 40), Red, 0.4),
                       Item(Sphere({ 5, 0, 9 }, 20), Green),
                       Item(Sphere({ 60, 0, 0 }, 15), Blue) },
                     {},
                     {} };
  RenderSettings settings = Small();
  settings.style = PictureStyle::Transparent;
  const Picture transparent = Draw(m_Renderer, scene, settings);
  ASSERT_EQ(transparent.channels, 4);
  EXPECT_EQ(transparent.At(0, 0)[3], 0);
  int between = 0;
  for (const Colour & background : { Colour{ 1, 1, 1 }, Colour{ 0.2, 0.6, 0.4 } })
  {
    settings.style = PictureStyle::Paper;
    settings.background = background;
    const Picture paper = Draw(m_Renderer, scene, settings);
    ASSERT_EQ(paper.channels, 3);
    for (int y = 0; y < paper.height; ++y)
    {
      for (int x = 0; x < paper.width; ++x)
      {
        const auto over = Over(transparent.At(x, y), background);
        between += transparent.At(x, y)[3] > 0 && transparent.At(x, y)[3] < 255;
        for (std::size_t channel = 0; channel < 3; ++channel)
        {
          ASSERT_NEAR(over[channel], paper.At(x, y)[channel], 1.6) << x << ", " << y;
        }
      }
    }
  }
  EXPECT_GT(between, 1000);
}

TEST_F(ScenePicture, StylesHaveTheirBackgrounds)
{
  RenderSettings settings = Small();
  const std::vector<SceneSurface> scene{ Item(Sphere({ 0, 0, 0 }, 40), Red) };
  EXPECT_EQ(Draw(m_Renderer, scene, settings).At(0, 0)[0], 0);
  settings.style = PictureStyle::Paper;
  EXPECT_EQ(Draw(m_Renderer, scene, settings).At(0, 0)[0], 255);
  settings.background = Colour{ 0.2, 0.2, 0.2 };
  EXPECT_EQ(Draw(m_Renderer, scene, settings).At(0, 0)[0], 51);
}

TEST_F(ScenePicture, GlossySurfaceHasAHighlight)
{
  auto item = Item(Sphere({ 0, 0, 0 }, 40), { 0.5, 0.2, 0.2 });
  const auto brightest = [this, &item] {
    const Picture picture = Draw(m_Renderer, { item }, Plain());
    return *std::max_element(picture.pixels.begin(), picture.pixels.end());
  };
  const int matte = brightest();
  item.isGlossy = true;
  EXPECT_GT(brightest(), matte + 50);
}

// Occlusion and outlines

TEST_F(ScenePicture, PlanesAndConvexBodiesTakeNoLight)
{
  for (const auto & surface : { Sphere({ 0, 0, 0 }, 40), Sphere({ 0, 0, 0 }, 2) })
  {
    RenderSettings settings = Plain();
    const Picture plain = Draw(m_Renderer, { Item(surface, Red) }, settings);
    settings.ambientOcclusion = true;
    EXPECT_LE(LargestDifference(Draw(m_Renderer, { Item(surface, Red) }, settings), plain), 4.0);
  }
}

TEST_F(ScenePicture, CavityIsDarker)
{
  // A ball between two others.
  const std::vector<SceneSurface> scene{ Item(Sphere({ -30, -10, 0 }, 30), Red),
                                         Item(Sphere({ 30, -10, 0 }, 30), Red),
                                         Item(Sphere({ 0, 20, 0 }, 30), Red) };
  RenderSettings settings = Plain();
  const Picture plain = Draw(m_Renderer, scene, settings);
  settings.ambientOcclusion = true;
  const Picture shaded = Draw(m_Renderer, scene, settings);
  EXPECT_LT(shaded.At(100, 86)[0], 0.8 * plain.At(100, 86)[0]);
  EXPECT_NEAR(shaded.At(40, 80)[0], plain.At(40, 80)[0], 12);
}

TEST_F(ScenePicture, PitsShallowerThanTrianglesAreLongAreNotDarker)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> depth(0.0, 0.65);
  const auto rough = Relief([&](int, int) { return depth(random); });
  const auto stepped = Relief([](int x, int z) { return 0.6 * (((x + 2 * z) / 5) % 2); });
  const auto diamonds = Relief([](int x, int z) { return x % 4 == 0 && z % 6 == 0 ? 0.65 : 0.0; });
  for (const auto & surface : { rough, stepped, diamonds })
  {
    for (const View & view : { View(), ViewFromText("20,10") })
    {
      for (const double zoom : { 1.0, 4.0 })
      {
        RenderSettings settings = Plain();
        settings.zoom = zoom;
        const Picture plain = Draw(m_Renderer, { Item(surface, Red) }, settings, view);
        settings.ambientOcclusion = true;
        settings.silhouettes = true;
        const Picture shaded = Draw(m_Renderer, { Item(surface, Red) }, settings, view);
        for (int y = 50; y < 110; ++y)
        {
          for (int x = 60; x < 140; ++x)
          {
            ASSERT_NEAR(shaded.At(x, y)[0], plain.At(x, y)[0], 1) << x << ", " << y << ", zoom " << zoom;
          }
        }
      }
    }
  }
}

TEST_F(ScenePicture, CavityIsAsDarkWhenEnlarged)
{
  const auto bowl = Relief([](int x, int z) { return 2.0 * std::sqrt(std::max(0, 9 - x * x - z * z)); });
  std::vector<double> bright;
  for (const double zoom : { 1.0, 2.0, 4.0 })
  {
    RenderSettings settings = Plain();
    settings.zoom = zoom;
    const int plain = Draw(m_Renderer, { Item(bowl, Red) }, settings).At(100, 80)[0];
    settings.ambientOcclusion = true;
    bright.push_back(Draw(m_Renderer, { Item(bowl, Red) }, settings).At(100, 80)[0] / static_cast<double>(plain));
  }
  EXPECT_LT(bright[0], 0.7);
  EXPECT_NEAR(bright[1], bright[0], 0.07);
  EXPECT_NEAR(bright[2], bright[0], 0.07);
}

TEST_F(ScenePicture, OutlinesAreDarkAndCanBeTurnedOff)
{
  const std::vector<SceneSurface> scene{ Item(Box({ -80, 40, -80 }, { 80, 50, 80 }), { 0.8, 0.8, 0.8 }),
                                         Item(Sphere({ 0, 0, 0 }, 25), { 0.8, 0.8, 0.8 }) };
  RenderSettings settings = Plain();
  const auto darkest = [this, &scene, &settings] {
    const Picture picture = Draw(m_Renderer, scene, settings);
    int least = 255;
    for (int x = 70; x < 130; ++x)
    {
      least = std::min<int>(least, picture.At(x, 80)[0]);
    }
    return least;
  };
  const int plain = darkest();
  settings.silhouettes = true;
  EXPECT_LT(darkest(), plain - 25);
}

TEST_F(ScenePicture, TranslucentSurfacesHaveNeitherOcclusionNorOutlines)
{
  const std::vector<SceneSurface> scene{ Item(Sphere({ -20, 0, 0 }, 30), Red, 0.4),
                                         Item(Sphere({ 20, 0, 0 }, 30), Blue, 0.4) };
  EXPECT_EQ(Draw(m_Renderer, scene, Small()).pixels, Draw(m_Renderer, scene, Plain()).pixels);
}

// Cuts

TEST_F(ScenePicture, CutRemovesOneSideOfTheSurfacesItNames)
{
  Scene scene{ { Item(Sphere({ 0, 0, 0 }, 40), Red), Item(Sphere({ 0, 0, 0 }, 20), Green) }, {}, {} };
  scene.surfaces[0].name = "shell";
  scene.surfaces[1].name = "core";
  RenderSettings settings = Plain();
  settings.margins = Margins{};
  EXPECT_GT(Draw(m_Renderer, scene, settings).At(100, 80)[0], 100);
  // The patient's left half is removed: right in the picture.
  scene.cuts = { { { 0, 0, 0 }, { 3, 0, 0 }, { "shell" } } };
  const Picture cut = Draw(m_Renderer, scene, settings);
  EXPECT_GT(cut.At(90, 80)[0], 100);
  EXPECT_GT(cut.At(120, 80)[1], 100);
  EXPECT_LT(cut.At(160, 80)[0] + cut.At(160, 80)[1], 1);
  EXPECT_GT(cut.At(40, 80)[0], 100);
  scene.cuts = { { { 0, 0, 0 }, { 1, 0, 0 }, {} } };
  const Picture both = Draw(m_Renderer, scene, settings);
  EXPECT_EQ(both.At(101, 80)[0] + both.At(101, 80)[1], 0);
  EXPECT_GT(both.At(98, 80)[0], 100);
}

TEST_F(ScenePicture, UndersidesSeenThroughCutsAreNotBlack)
{
  for (const bool hasNormals : { true, false })
  {
    auto surface = itk::TriangleSurface::New();
    surface->Graft(Sphere({ 0, 0, 0 }, 40));
    if (!hasNormals)
    {
      surface->GetNormals().clear();
    }
    Scene scene{ { Item(surface, { 0.8, 0.8, 0.8 }) }, { { { 0, 0, 0 }, { 0, -1, 0 }, {} } }, {} };
    const Picture picture = Draw(m_Renderer, scene, Small());
    for (int x = 40; x < 160; ++x)
    {
      EXPECT_GT(picture.At(x, 80)[0], 40) << x;
    }
  }
}

TEST_F(ScenePicture, SeveralCutsLeaveACorner)
{
  const Scene scene{ { Item(Box({ -40, -40, -40 }, { 40, 40, 40 }), Red) },
                     { { { 0, 0, 0 }, { 1, 0, 0 }, {} }, { { 0, 0, 0 }, { 0, 0, 1 }, {} } },
                     {} };
  const Picture picture = Draw(m_Renderer, scene, Plain());
  EXPECT_GT(picture.At(80, 100)[0], 60);
  EXPECT_EQ(picture.At(120, 100)[0], 0);
  EXPECT_EQ(picture.At(80, 60)[0], 0);
}

// Planes

TEST_F(ScenePicture, CapIsInItsCutAndNotLit)
{
  // A ball cut in half, with a cap of one grey as wide as the ball's box.
  const Projection place{ View().frame, { 0, 0, 0 }, 2.0, 40, 40 };
  const Scene scene{ { Item(Sphere({ 0, 0, 0 }, 40), Red) },
                     { { { 0, 0, 0 }, { 0, -1, 0 }, {} } },
                     { { OneColour(40, 40, { 90, 91, 92 }), place } } };
  for (const View & view : { View(), ObliqueView(35, 20), ObliqueView(-50, -30) })
  {
    const auto rendered = m_Renderer.Render(scene, Small(), { view }).front();
    for (double x = -37.0; x <= 37.0; x += 3.7)
    {
      for (double z = -37.0; z <= 37.0; z += 3.7)
      {
        const auto seen = rendered.projection->PositionOf({ x, 0.0, z });
        const auto * const pixel = rendered.picture.At(static_cast<int>(seen.x), static_cast<int>(seen.y));
        EXPECT_EQ(pixel[0], 90) << x << ", " << z;
        EXPECT_EQ(pixel[1], 91);
        EXPECT_EQ(pixel[2], 92);
      }
    }
  }
}

TEST_F(ScenePicture, PlaneLiesWhereItsProjectionSays)
{
  // Random pixels of 8 x 8 mm, most transparent, in a coronal, a sagittal and an axial plane.
  std::mt19937 random(3);
  for (const std::size_t direction : { 0U, 2U, 5U })
  {
    Picture picture(9, 7, 4);
    for (std::size_t n = 0; n < picture.pixels.size(); n += 4)
    {
      const std::uint32_t value = random();
      picture.pixels[n] = static_cast<std::uint8_t>(value);
      picture.pixels[n + 1] = static_cast<std::uint8_t>(value >> 8);
      picture.pixels[n + 3] = (value >> 16 & 3) == 0 ? 0 : 255;
    }
    const Projection place{ StandardViews()[direction].frame, { 5, -7, 11 }, 8.0, 9, 7 };
    RenderSettings settings = Plain();
    settings.width = settings.height = 200;
    settings.extent = LPSBox{ { -40, -40, -40 }, { 50, 50, 50 } };
    const auto rendered =
      m_Renderer.Render({ {}, {}, { { picture, place } } }, settings, { StandardViews()[direction] }).front();
    for (int y = 0; y < 7; ++y)
    {
      for (int x = 0; x < 9; ++x)
      {
        const auto seen = rendered.projection->PositionOf(place.PointAt({ x + 0.5, y + 0.5 }));
        const auto * const pixel = rendered.picture.At(static_cast<int>(seen.x), static_cast<int>(seen.y));
        const auto * const expected = picture.At(x, y);
        EXPECT_NEAR(pixel[0], expected[3] == 0 ? 0 : expected[0], 24) << x << ", " << y;
        EXPECT_NEAR(pixel[1], expected[3] == 0 ? 0 : expected[1], 24) << x << ", " << y;
      }
    }
  }
}

TEST_F(ScenePicture, PlaneHidesWhatIsBehindAndLetsLightPassAsItsAlphaSays)
{
  const Projection place{ View().frame, { 0, 0, 0 }, 10.0, 8, 8 };
  const auto front = Item(Sphere({ -20, -30, 0 }, 15), Red);
  const auto back = Item(Sphere({ 20, 30, 0 }, 15), Green);
  Scene scene{ { front, back }, {}, { { OneColour(8, 8, { 0, 0, 255, 255 }), place } } };
  RenderSettings settings = Plain();
  settings.extent = LPSBox{ { -40, -40, -40 }, { 40, 40, 40 } };
  settings.margins = Margins{};
  const Picture opaque = Draw(m_Renderer, scene, settings);
  EXPECT_GT(opaque.At(60, 80)[0], 100);
  EXPECT_EQ(opaque.At(140, 80)[2], 255);
  EXPECT_EQ(opaque.At(140, 80)[1], 0);
  scene.planes[0].picture = OneColour(8, 8, { 0, 0, 255, 51 });
  const Picture veil = Draw(m_Renderer, scene, settings);
  scene.planes.clear();
  const Picture without = Draw(m_Renderer, scene, settings);
  EXPECT_EQ(veil.At(60, 80)[0], without.At(60, 80)[0]);
  EXPECT_NEAR(veil.At(140, 80)[1], 0.8 * without.At(140, 80)[1], 1.0);
  EXPECT_NEAR(veil.At(140, 80)[2], 51 + 0.8 * without.At(140, 80)[2], 1.0);
  EXPECT_NEAR(veil.At(100, 20)[2], 51, 1);
}

// Surfaces in one place

TEST_F(ScenePicture, OfSurfacesInOnePlaceTheFirstIsSeen)
{
  // Faces of two boxes in one plane, cut into other triangles.
  const auto wide = Item(Box({ -40, 0, -40 }, { 40, 50, 40 }), Red);
  const auto narrow = Item(Box({ -21, 0, -23 }, { 22, 30, 27 }), Green);
  for (const View & view : { View(), ObliqueView(35, 20), ObliqueView(-10, 60) })
  {
    const auto seen = [this, &view](const std::vector<SceneSurface> & surfaces, int channel) {
      const auto rendered = m_Renderer.Render({ surfaces, {}, {} }, Plain(), { view }).front();
      for (double x = -19.0; x < 20.0; x += 1.7)
      {
        for (double z = -21.0; z < 25.0; z += 1.7)
        {
          const auto at = rendered.projection->PositionOf({ x, 0.0, z });
          const auto * const pixel = rendered.picture.At(static_cast<int>(at.x), static_cast<int>(at.y));
          EXPECT_GT(pixel[channel], 2 * pixel[1 - channel]) << view.name << ": " << x << ", " << z;
        }
      }
    };
    seen({ wide, narrow }, 0);
    seen({ narrow, wide }, 1);
  }
}

TEST_F(ScenePicture, LaterLayersGiveWayToEarlierOnesThatLieLittleBehindThem)
{
  const auto back = Item(Box({ -40, 0, -40 }, { 40, 50, 40 }), Red);
  RenderSettings settings = Plain();
  settings.pixelSize = 0.6;
  for (const double nearer : { 0.03, 0.2, 0.3, 0.42, 0.8, 2.0 })
  {
    auto front = Item(Box({ -21, -nearer, -23 }, { 22, 30, 27 }), Green);
    for (const auto & [layer, gap, most] : { std::tuple(0u, 0.0, 0.0), { 1u, 0.0, 0.36 }, { 1u, 1.0, 1.0 } })
    {
      front.layer = layer;
      front.layerGap = gap;
      for (const View & view : { View(), ObliqueView(10, 10) })
      {
        const auto rendered = m_Renderer.Render({ { back, front }, {}, {} }, settings, { view }).front();
        const auto at = rendered.projection->PositionOf({ 0.0, 0.0, 0.0 });
        const auto * const pixel = rendered.picture.At(static_cast<int>(at.x), static_cast<int>(at.y));
        EXPECT_EQ(pixel[0] > pixel[1], nearer < most) << view.name << ": " << nearer << ", " << most;
      }
    }
  }
}

TEST_F(ScenePicture, LaterLayersGiveWayWhereTheyAreSeenAtAGrazingAngle)
{
  auto outer = Item(Sphere({ 0, 0, 0 }, 40.0), Red);
  outer.layer = 1;
  outer.layerGap = 0.5;
  const auto inner = Item(Sphere({ 0, 0, 0 }, 39.7), Green);
  for (const bool perspective : { false, true })
  {
    RenderSettings settings = Plain();
    settings.perspective = perspective;
    const Picture picture = Draw(m_Renderer, { outer, inner }, settings);
    double red = 1e9, farthest = 0.0; // pixels from the middle: the first that is red, and the last of any
    for (int row = 0; row < picture.height; ++row)
    {
      for (int column = 0; column < picture.width; ++column)
      {
        const double distance = std::hypot(column + 0.5 - 0.5 * picture.width, row + 0.5 - 0.5 * picture.height);
        const auto * const pixel = picture.At(column, row);
        red = pixel[0] > pixel[1] ? std::min(red, distance) : red;
        farthest = pixel[0] != pixel[1] ? std::max(farthest, distance) : farthest;
      }
    }
    EXPECT_GT(red, 0.97 * farthest) << perspective;
    EXPECT_GT(farthest, 50.0) << perspective;
  }
}

TEST_F(ScenePicture, LaterLayersOfFlatScenesAreNotLost)
{
  const auto first = Item(Box({ -40, 0, -40 }, { -5, 0.3, 40 }), Red);
  auto later = Item(Box({ 5, 0.1, -40 }, { 40, 0.3, 40 }), Green);
  for (const bool perspective : { false, true })
  {
    RenderSettings settings = Plain();
    settings.perspective = perspective;
    const Picture without = Draw(m_Renderer, { first, later }, settings);
    for (const std::size_t layer : { 1, 4, 100 })
    {
      later.layer = layer;
      EXPECT_EQ(Draw(m_Renderer, { first, later }, settings).pixels == without.pixels, true) << layer;
    }
    later.layer = 0;
  }
}

// Backs of triangles

TEST_F(ScenePicture, HiddenBacksOfClosedSurfacesAreNotMissed)
{
  const auto box = Box({ -30, -20, -40 }, { 30, 20, 40 });
  for (const bool perspective : { false, true })
  {
    RenderSettings settings = Small();
    settings.perspective = perspective;
    const View view = ObliqueView(30, 20);
    const Picture closed = Draw(m_Renderer, { Item(box, Red) }, settings, view);
    const Picture all = Draw(m_Renderer, { Item(Separated(box), Red) }, settings, view);
    int different = 0; // at the outline, where fronts and backs have the same depth
    for (std::size_t n = 0; n < all.pixels.size(); n += 3)
    {
      different += closed.pixels[n] != all.pixels[n];
    }
    EXPECT_LT(different, 20);
  }
}

TEST_F(ScenePicture, InsidesOfOpenAndInvertedSurfacesAreSeen)
{
  const auto open = Box({ -30, -20, -40 }, { 30, 20, 40 });
  open->GetTriangles().erase(open->GetTriangles().begin() + 4, open->GetTriangles().begin() + 6); // the front
  const Picture picture = Draw(m_Renderer, { Item(open, Red) }, Small());
  EXPECT_GT(picture.At(100, 80)[0], 60);
  const auto inverted = Box({ -30, -20, -40 }, { 30, 20, 40 });
  for (auto & triangle : inverted->GetTriangles())
  {
    std::swap(triangle[0], triangle[1]);
  }
  const auto back = Item(Sphere({ 0, 0, 0 }, 10), Green);
  const Picture closed = Draw(m_Renderer, { Item(inverted, Red), back }, Plain());
  EXPECT_GT(closed.At(100, 80)[0], closed.At(100, 80)[1]);
}

// Bad input

TEST_F(ScenePicture, WhatCannotBeDrawnIsSaidInASentence)
{
  const Scene good{ { Item(Sphere({ 0, 0, 0 }, 40), Red) }, {}, {} };
  const auto kind = [&](const Scene & scene, const RenderSettings & settings) {
    return KindThrownBy(m_Renderer, scene, settings);
  };
  for (const double bad : { 0.0, -1.0, std::nan(""), HUGE_VAL })
  {
    RenderSettings settings = Small();
    settings.zoom = bad;
    EXPECT_EQ(kind(good, settings), FailureKind::Usage);
    settings = Small();
    settings.pixelSize = bad;
    EXPECT_EQ(kind(good, settings), FailureKind::Usage);
  }
  RenderSettings settings = Small();
  settings.pixelSize = 1.0;
  settings.perspective = true;
  EXPECT_EQ(kind(good, settings), FailureKind::Usage);
  settings = Small();
  settings.margins = Margins{ 100, 100, 0, 0 };
  EXPECT_EQ(kind(good, settings), FailureKind::Usage);
  settings.margins = Margins{ -1, 0, 0, 0 };
  EXPECT_EQ(kind(good, settings), FailureKind::Usage);
  settings = Small();
  settings.extent = LPSBox{ { 0, 0, 0 }, { 1, 0, 1 } };
  EXPECT_EQ(kind(good, settings), FailureKind::Usage);
  settings = Small();
  settings.width = 0;
  settings.pixelSize = 1e-4; // a picture of 800,000 pixels
  EXPECT_EQ(kind(good, settings), FailureKind::Usage);

  Scene scene = good;
  scene.cuts = { { { 0, 0, 0 }, { 0, 0, 0 }, {} } };
  EXPECT_EQ(kind(scene, Small()), FailureKind::Usage);
  scene.cuts = { { { 0, 0, 0 }, { 0, 0, 1 }, { "tset" } } };
  EXPECT_EQ(kind(scene, Small()), FailureKind::Usage);
  scene.cuts = std::vector<ClipPlane>(7, { { 0, 0, 0 }, { 0, 0, 1 }, {} });
  EXPECT_EQ(kind(scene, Small()), FailureKind::Usage);
  scene = good;
  scene.planes = { { OneColour(3, 3, { 0, 0, 0 }), { View().frame, { 0, 0, 0 }, 1.0, 3, 4 } } };
  EXPECT_EQ(kind(scene, Small()), FailureKind::Usage);
}

} // namespace
