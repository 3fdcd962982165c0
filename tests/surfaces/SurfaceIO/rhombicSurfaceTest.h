#ifndef rhombicSurfaceTest_h
#define rhombicSurfaceTest_h

#include "rhombicFailure.h"
#include "rhombicSurfaceIO.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <random>

namespace fs = std::filesystem;

using Surface = itk::TriangleSurface;
using rhombic::SceneSurface;
using rhombic::SurfaceFileSpace;

/** Reads a file of any format in this process. */
inline std::vector<SceneSurface>
ReadSurfaces(const fs::path & path)
{
  return rhombic::ReadSurfaces(path);
}

/** A sphere of 8 * 4^levels triangles, facing outwards: a subdivided octahedron. */
inline Surface::Pointer
MakeSphere(int levels, float radius = 15.0f, const Surface::PointType & centre = { 10, -20, 30 })
{
  auto surface = Surface::New();
  auto & points = surface->GetPoints();
  points = { { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 }, { 0, 0, -1 } };
  Surface::TrianglesContainer triangles{ { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
                                         { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
  for (int level = 0; level < levels; ++level)
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [place, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (isNew)
      {
        Surface::PointType sum{ points[a][0] + points[b][0], points[a][1] + points[b][1], points[a][2] + points[b][2] };
        const float length = std::hypot(sum[0], sum[1], sum[2]);
        points.push_back({ sum[0] / length, sum[1] / length, sum[2] / length });
      }
      return place->second;
    };
    Surface::TrianglesContainer finer;
    for (const auto & [a, b, c] : triangles)
    {
      const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), { { a, ab, ca }, { ab, b, bc }, { ca, bc, c }, { ab, bc, ca } });
    }
    triangles.swap(finer);
  }
  surface->GetTriangles() = triangles;
  surface->GetNormals() = points;
  for (auto & point : points)
  {
    point = { centre[0] + radius * point[0], centre[1] + radius * point[1], centre[2] + radius * point[2] };
  }
  return surface;
}

/** Three separate spheres with names that are difficult for file formats. */
inline std::vector<SceneSurface>
MakeScene()
{
  return { { "left kidney", MakeSphere(3), { 220 / 255.0, 170 / 255.0, 120 / 255.0 }, 1.0 },
           { "Gef\xc3\xa4\xc3\x9f \"2\" <&> # \\ back",
             MakeSphere(2, 4, { -31.7f, 5.3f, -120 }),
             { 0, 151 / 255.0, 206 / 255.0 },
             0.3 },
           { "left kidney", MakeSphere(1, 0.001f, { 1e-4f, -1e6f, 0 }), { 1, 0, 1 }, 0.75 } };
}

/** Random points of very different magnitudes, and random triangles of them. */
inline Surface::Pointer
MakeRandomSurface(unsigned int seed, std::uint32_t points = 300, int triangles = 500)
{
  std::mt19937 random(seed);
  const auto anyFloat = [&random] {
    const float size = std::ldexp(1.0f, static_cast<int>(random() % 60) - 40);
    return (static_cast<float>(random()) / 2147483648.0f - 1) * size;
  };
  auto surface = Surface::New();
  for (std::uint32_t n = 0; n < points; ++n)
  {
    surface->GetPoints().push_back({ anyFloat(), anyFloat(), anyFloat() });
    const double z = 2.0 * random() / 4294967296.0 - 1, angle = 6.28 * random() / 4294967296.0,
                 r = std::sqrt(1 - z * z);
    surface->GetNormals().push_back(
      { static_cast<float>(r * std::cos(angle)), static_cast<float>(r * std::sin(angle)), static_cast<float>(z) });
  }
  for (int n = 0; n < triangles; ++n)
  {
    const auto a = static_cast<std::uint32_t>(random() % points), b = static_cast<std::uint32_t>(random() % points);
    surface->GetTriangles().push_back({ a, b, static_cast<std::uint32_t>(random() % points) });
  }
  surface->RemoveUnusedPoints();
  return surface;
}

/** Removes triangles with one point at two corners, which 3MF forbids. */
inline void
RemoveDegenerate(Surface & surface)
{
  auto & triangles = surface.GetTriangles();
  const auto isDegenerate = [](const auto & t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; };
  triangles.erase(std::remove_if(triangles.begin(), triangles.end(), isDegenerate), triangles.end());
}

inline std::string
ReadBytes(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), {} };
}

inline void
WriteBytes(const fs::path & path, const std::string & bytes)
{
  std::ofstream file(path, std::ios::binary);
  file << bytes;
}

/** The kind of an action's failure. Fails the test if the action succeeds, or if the message does not contain \a named
 * or is not a sentence. */
template <typename TAction>
rhombic::FailureKind
KindOf(TAction action, const std::string & named)
{
  try
  {
    action();
  }
  catch (const rhombic::Failure & failure)
  {
    const std::string sentence = failure.GetDescription();
    EXPECT_NE(sentence.find(named), std::string::npos) << sentence;
    EXPECT_EQ(sentence.back(), '.') << sentence;
    return failure.GetKind();
  }
  ADD_FAILURE() << "nothing was thrown for " << named;
  return rhombic::FailureKind::Internal;
}

class SurfaceTest : public testing::Test
{
private:
  const rhombictest::TemporaryFolder m_TemporaryFolder;

protected:
  static constexpr const char * Extensions[]{ ".stl", ".ply", ".obj", ".vtp", ".glb", ".3mf" };
  static constexpr const char * SceneExtensions[]{ ".ply", ".obj", ".vtp", ".glb", ".3mf" };

  std::size_t
  CountFiles() const
  {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(m_Folder), fs::directory_iterator()));
  }

  const fs::path m_Folder = m_TemporaryFolder.Path();
};

#endif
