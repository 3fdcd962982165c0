#include "itkTriangleSurfaceCurvature.h"

#include "detail/itkPositionArithmetic.h"
#include "detail/itkTrianglesOfPoints.h"
#include "itkTriangleSurfaceThickness.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>

namespace itk
{
namespace
{

constexpr std::size_t CurvatureBlock = 8192;
constexpr std::size_t FewestNeighbours = 12; // twice the polynomial's coefficients
constexpr std::size_t Coefficients = 6;

/** \class JetFit
 * \brief Fits z = a + b x + c y + d x^2 + e x y + f y^2 by least squares. */
class JetFit
{
public:
  void
  Add(double x, double y, double z)
  {
    const std::array<double, Coefficients> row{ 1.0, x, y, x * x, x * y, y * y };
    for (std::size_t i = 0; i < Coefficients; ++i)
    {
      for (std::size_t j = 0; j <= i; ++j)
      {
        m_Matrix[i][j] += row[i] * row[j];
      }
      m_Right[i] += row[i] * z;
    }
  }

  /** Solves by Cholesky's decomposition. Returns false if the points leave coefficients open. */
  bool
  Solve()
  {
    for (std::size_t i = 0; i < Coefficients; ++i)
    {
      const double before = m_Matrix[i][i];
      for (std::size_t j = 0; j <= i; ++j)
      {
        double sum = m_Matrix[i][j];
        for (std::size_t k = 0; k < j; ++k)
        {
          sum -= m_Matrix[i][k] * m_Matrix[j][k];
        }
        constexpr double rounding = 1e-10;
        if (i == j && !(sum > rounding * before))
        {
          return false;
        }
        m_Matrix[i][j] = i == j ? std::sqrt(sum) : sum / m_Matrix[j][j];
      }
      for (std::size_t k = 0; k < i; ++k)
      {
        m_Right[i] -= m_Matrix[i][k] * m_Right[k];
      }
      m_Right[i] /= m_Matrix[i][i];
    }
    for (std::size_t i = Coefficients; i-- > 0;)
    {
      for (std::size_t k = i + 1; k < Coefficients; ++k)
      {
        m_Right[i] -= m_Matrix[k][i] * m_Right[k];
      }
      m_Right[i] /= m_Matrix[i][i];
    }
    return true;
  }

  /** The mean curvature at x = y = 0, above 0 where z falls in all directions. */
  double
  GetMeanCurvature() const
  {
    const auto & [a, zx, zy, d, zxy, f] = m_Right;
    const double steepness = 1.0 + zx * zx + zy * zy;
    return -((1.0 + zy * zy) * d - zx * zy * zxy + (1.0 + zx * zx) * f) / std::pow(steepness, 1.5);
  }

private:
  std::array<std::array<double, Coefficients>, Coefficients> m_Matrix{}; ///< the lower half
  std::array<double, Coefficients> m_Right{};                            ///< the coefficients, once solved
};

/** \class Neighbourhoods
 * \brief Finds the points around a point along the edges of a surface. */
class Neighbourhoods
{
public:
  Neighbourhoods(const TriangleSurface & surface, const TrianglesOfPoints & fans, double radius)
    : m_Surface(surface)
    , m_Fans(fans)
    , m_SquaredRadius(radius * radius)
    , m_FoundFor(surface.GetNumberOfPoints(), std::numeric_limits<std::uint32_t>::max())
  {}

  /** The point, then others from ring to ring. */
  const std::vector<std::uint32_t> &
  Find(std::uint32_t point)
  {
    const PositionType centre = ToPosition(m_Surface.GetPoints()[point]);
    m_Found.assign(1, point);
    m_FoundFor[point] = point;
    for (std::size_t n = 0; n < m_Found.size(); ++n)
    {
      const auto add = [&](std::uint32_t other) {
        const bool isNear = SquaredDistance(centre, ToPosition(m_Surface.GetPoints()[other])) <= m_SquaredRadius;
        if ((isNear || m_Found.size() <= FewestNeighbours) && m_FoundFor[other] != point)
        {
          m_FoundFor[other] = point;
          m_Found.push_back(other);
        }
      };
      m_Fans.VisitNeighbours(m_Found[n], [&](std::uint32_t next, std::uint32_t last) {
        add(next);
        add(last);
      });
    }
    return m_Found;
  }

private:
  const TriangleSurface & m_Surface;
  const TrianglesOfPoints & m_Fans;
  double m_SquaredRadius;
  BulkVector<std::uint32_t> m_FoundFor; ///< the last point around which each point was found
  std::vector<std::uint32_t> m_Found;
};

/** Two directions at right angles to a normal and to each other. */
std::array<PositionType, 2>
TangentsOf(const PositionType & normal)
{
  const std::size_t axis = std::abs(normal[0]) < 0.6 ? 0 : 1; // not along the normal
  PositionType other{};
  other[axis] = 1.0;
  const PositionType across = Cross(normal, other);
  const PositionType first = Scaled(across, 1.0 / Length(across));
  return { first, Cross(normal, first) };
}

} // namespace

BulkVector<float>
ComputeTriangleSurfaceMeanCurvature(const TriangleSurface & surface, double radius)
{
  const BulkVector<PositionType> normals = ComputeTriangleSurfacePointNormals(surface);
  const TrianglesOfPoints fans(surface);
  BulkVector<float> curvatures(normals.size(), std::numeric_limits<float>::quiet_NaN());
  std::mutex mutex;
  std::vector<std::unique_ptr<Neighbourhoods>> free; // as many as threads
  rhombic::ForEachBlock(normals.size(), CurvatureBlock, [&](std::size_t begin, std::size_t end) {
    std::unique_lock<std::mutex> lock(mutex);
    auto neighbourhoods =
      free.empty() ? std::make_unique<Neighbourhoods>(surface, fans, radius) : std::move(free.back());
    free.empty() ? void() : free.pop_back();
    lock.unlock();
    for (std::size_t n = begin; n < end; ++n)
    {
      if (normals[n] == PositionType{} || !IsFinite(surface.GetPoints()[n]))
      {
        continue;
      }
      const PositionType centre = ToPosition(surface.GetPoints()[n]);
      const auto [x, y] = TangentsOf(normals[n]);
      JetFit fit;
      for (const std::uint32_t point : neighbourhoods->Find(static_cast<std::uint32_t>(n)))
      {
        const PositionType way = Scaled(Subtract(ToPosition(surface.GetPoints()[point]), centre), 1.0 / radius);
        fit.Add(Dot(way, x), Dot(way, y), Dot(way, normals[n]));
      }
      if (fit.Solve())
      {
        curvatures[n] = static_cast<float>(fit.GetMeanCurvature() / radius);
      }
    }
    lock.lock();
    free.push_back(std::move(neighbourhoods));
  });
  return curvatures;
}

} // namespace itk
