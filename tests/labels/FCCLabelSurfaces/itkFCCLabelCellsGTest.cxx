#include "itkFCCLabelCells.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>

namespace
{

using Cells = itk::FCCLabelCells;
using Vector = std::array<double, 3>;

Vector
Subtract(const Vector & a, const Vector & b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double
Orientation(const Vector & a, const Vector & b, const Vector & c, const Vector & d)
{
  const Vector u = Subtract(b, a);
  const Vector v = Subtract(c, a);
  const Vector w = Subtract(d, a);
  return (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2];
}

/** The cut edges of a tetrahedron with some labels. */
unsigned int
PatternOf(const std::array<int, 4> & labels)
{
  unsigned int pattern = 0;
  for (unsigned int a = 0; a < 4; ++a)
  {
    for (unsigned int b = a + 1; b < 4; ++b)
    {
      pattern |= labels[a] != labels[b] ? 1u << Cells::EdgeBetween(a, b) : 0;
    }
  }
  return pattern;
}

template <typename TUse>
void
ForEachLabelling(const TUse & use)
{
  for (int n = 0; n < 256; ++n)
  {
    use(std::array<int, 4>{ n & 3, n >> 2 & 3, n >> 4 & 3, n >> 6 & 3 });
  }
}

TEST(FCCLabelCells, ThereAreFifteenCasesWithOneTwoFiveOrTwelveTriangles)
{
  std::set<unsigned int> patterns;
  ForEachLabelling([&](const std::array<int, 4> & labels) {
    const unsigned int pattern = PatternOf(labels);
    patterns.insert(pattern);
    const std::map<int, unsigned int> triangles{ { 0, 0 }, { 3, 1 }, { 4, 2 }, { 5, 5 }, { 6, 12 } };
    EXPECT_EQ(itk::FCCLabelCases[pattern].size, triangles.at(__builtin_popcount(pattern)));
  });
  EXPECT_EQ(patterns.size(), 15u);
  for (unsigned int pattern = 0; pattern < Cells::Cases; ++pattern)
  {
    EXPECT_EQ(itk::FCCLabelCases[pattern].exists, patterns.count(pattern) == 1);
  }
}

/** The walls of any labels in the tetrahedron of the unit axes, with points anywhere in their simplices. */
class Walls
{
public:
  Walls(const std::array<int, 4> & labels, unsigned int seed)
    : m_Labels(labels)
    , m_Case(itk::FCCLabelCases[PatternOf(labels)])
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(0.001, 1.0);
    for (unsigned int set = 1; set < 16; ++set)
    {
      double sum = 0.0;
      for (unsigned int n = 0; n < 4; ++n)
      {
        const double weight = (set >> n & 1) != 0 ? std::pow(share(random), 4.0) : 0.0;
        sum += weight;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          m_Points[set][axis] += weight * Corner(n)[axis];
        }
      }
      for (double & coordinate : m_Points[set])
      {
        coordinate /= sum;
      }
    }
  }

  /** A positive tetrahedron. */
  static Vector
  Corner(unsigned int n)
  {
    return { n == 1 ? 1.0 : 0.0, n == 2 ? 1.0 : 0.0, n == 3 ? 1.0 : 0.0 };
  }

  const Cells::Case &
  GetCase() const
  {
    return m_Case;
  }

  const Vector &
  GetPoint(unsigned int set) const
  {
    return m_Points[set];
  }

  int
  LabelOf(unsigned int site) const
  {
    return m_Labels[site];
  }

  /** The number of times that a segment crosses the walls, or -1 if it passes close to an edge of one. */
  int
  CountCrossings(const Vector & from, const Vector & to) const
  {
    int crossings = 0;
    for (unsigned int n = 0; n < m_Case.size; ++n)
    {
      const auto & corners = m_Case.triangles[n].corners;
      const Vector & a = m_Points[corners[0]];
      const Vector & b = m_Points[corners[1]];
      const Vector & c = m_Points[corners[2]];
      const double u = Orientation(from, to, a, b);
      const double v = Orientation(from, to, b, c);
      const double w = Orientation(from, to, c, a);
      constexpr double close = 1e-12;
      if (std::abs(u) < close || std::abs(v) < close || std::abs(w) < close)
      {
        return -1;
      }
      if ((u > 0) == (v > 0) && (v > 0) == (w > 0) &&
          (Orientation(a, b, c, from) > 0) != (Orientation(a, b, c, to) > 0))
      {
        ++crossings;
      }
    }
    return crossings;
  }

private:
  std::array<int, 4> m_Labels;
  const Cells::Case & m_Case;
  std::array<Vector, 16> m_Points{};
};

TEST(FCCLabelCells, TrianglesPartTwoLabelsAndFaceTheFirst)
{
  ForEachLabelling([](const std::array<int, 4> & labels) {
    for (unsigned int seed = 0; seed < 20; ++seed)
    {
      const Walls walls(labels, seed);
      for (unsigned int n = 0; n < walls.GetCase().size; ++n)
      {
        const Cells::Triangle & triangle = walls.GetCase().triangles[n];
        EXPECT_NE(labels[triangle.sides[0]], labels[triangle.sides[1]]);
        const auto & corners = triangle.corners;
        // Each corner is of a simplex that has both sides; the line along their edge passes from front to back.
        unsigned int edges = 0;
        for (const unsigned int corner : corners)
        {
          EXPECT_EQ(corner & (1u << triangle.sides[0] | 1u << triangle.sides[1]) ? 1 : 0, 1);
          edges += itk::FCCCells::SizeOf(corner) == 2 ? 1 : 0;
        }
        EXPECT_GE(edges, 1u);
        const double orientation = Orientation(walls.GetPoint(corners[0]),
                                               walls.GetPoint(corners[1]),
                                               walls.GetPoint(corners[2]),
                                               Walls::Corner(triangle.sides[0]));
        EXPECT_GT(orientation, 0.0) << n;
      }
    }
  });
}

/** Every path between sites of different labels meets a wall. */
TEST(FCCLabelCells, EveryLabelIsEnclosed)
{
  ForEachLabelling([](const std::array<int, 4> & labels) {
    const Walls walls(labels, 7);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> share(0.01, 1.0);
    for (unsigned int trial = 0; trial < 20; ++trial)
    {
      Vector middle{};
      for (double & coordinate : middle)
      {
        coordinate = 0.33 * share(random);
      }
      for (unsigned int a = 0; a < 4; ++a)
      {
        for (unsigned int b = 0; b < 4; ++b)
        {
          const int there = walls.CountCrossings(Walls::Corner(a), middle);
          const int back = walls.CountCrossings(middle, Walls::Corner(b));
          if (there >= 0 && back >= 0 && labels[a] != labels[b])
          {
            EXPECT_GT(there + back, 0);
          }
        }
      }
    }
  });
}

/** Triangles have no point in common but those of common edges and corners: no edge of one passes through another. */
TEST(FCCLabelCells, TrianglesDoNotCross)
{
  ForEachLabelling([](const std::array<int, 4> & labels) {
    for (unsigned int seed = 0; seed < 50; ++seed)
    {
      const Walls walls(labels, seed);
      const Cells::Case & found = walls.GetCase();
      for (unsigned int n = 0; n < found.size; ++n)
      {
        for (unsigned int m = 0; m < found.size; ++m)
        {
          const auto & mine = found.triangles[m].corners;
          const auto & other = found.triangles[n].corners;
          for (unsigned int corner = 0; corner < 3; ++corner)
          {
            const unsigned int from = mine[corner];
            const unsigned int to = mine[(corner + 1) % 3];
            const std::set<unsigned int> set(other, other + 3);
            if (set.count(from) != 0 || set.count(to) != 0)
            {
              continue;
            }
            const Vector & p = walls.GetPoint(from);
            const Vector & q = walls.GetPoint(to);
            const Vector & a = walls.GetPoint(other[0]);
            const Vector & b = walls.GetPoint(other[1]);
            const Vector & c = walls.GetPoint(other[2]);
            constexpr double rounding = 1e-15;
            const double u = Orientation(p, q, a, b);
            const double v = Orientation(p, q, b, c);
            const double w = Orientation(p, q, c, a);
            const bool passes =
              (u > rounding && v > rounding && w > rounding) || (u < -rounding && v < -rounding && w < -rounding);
            const double s = Orientation(a, b, c, p);
            const double t = Orientation(a, b, c, q);
            EXPECT_FALSE(passes && std::min(s, t) < -rounding && std::max(s, t) > rounding);
          }
        }
      }
    }
  });
}

} // namespace
