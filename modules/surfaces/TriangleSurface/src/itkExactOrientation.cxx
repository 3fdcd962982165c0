// The filters and the expansion are those of J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast
// Robust Geometric Predicates", Discrete & Computational Geometry 18 (1997): a determinant in double decides when it
// exceeds the bound of its rounding error (there: ccwerrboundA, o3derrboundA), else it is computed exactly.
//
// Coordinates are float32, which makes the exact part short: a product of two (48 bits) is one double and a product of
// three (72 bits) the sum of two, without rounding. Nothing underflows or overflows: the products of three lie between
// 2^-447 and 2^384.
#include "detail/itkPositionArithmetic.h"

#include <array>
#include <cmath>
#include <limits>

namespace itk
{
namespace
{

using MeshPoint = TriangleSurface::PointType;

constexpr double RoundingUnit = std::numeric_limits<double>::epsilon() / 2.0; // 2^-53
constexpr double BoundInPlane = (3.0 + 16.0 * RoundingUnit) * RoundingUnit;
constexpr double BoundInSpace = (7.0 + 56.0 * RoundingUnit) * RoundingUnit;
constexpr int Uncertain = 2;

int
Sign(double value)
{
  return (value > 0.0) - (value < 0.0);
}

/** The sign of a determinant computed with rounding, or Uncertain. \a magnitude is the same sum of the products'
 * absolute values; if it is 0, nothing was rounded, because differences of float32 are 0 only if the two are equal. */
int
FilteredSign(double determinant, double magnitude, double bound)
{
  return std::abs(determinant) > bound * magnitude || magnitude == 0.0 ? Sign(determinant) : Uncertain;
}

/** An exact sum of doubles, kept as components of growing magnitude that do not overlap. */
template <std::size_t VCapacity>
class ExactSum
{
public:
  /** Shewchuk's Grow-Expansion (theorem 10), dropping zeros. */
  void
  Add(double term)
  {
    std::size_t kept = 0;
    for (std::size_t n = 0; n < m_Size; ++n)
    {
      const double sum = term + m_Components[n];
      const double virtualPart = sum - term;
      const double roundedOff = (term - (sum - virtualPart)) + (m_Components[n] - virtualPart);
      term = sum;
      if (roundedOff != 0.0)
      {
        m_Components[kept++] = roundedOff;
      }
    }
    if (term != 0.0)
    {
      m_Components[kept++] = term;
    }
    m_Size = kept;
  }

  /** The sign of the largest component. */
  int
  GetSign() const
  {
    return m_Size == 0 ? 0 : Sign(m_Components[m_Size - 1]);
  }

private:
  std::array<double, VCapacity> m_Components;
  std::size_t m_Size = 0;
};

/** Adds sign x y z. */
template <typename TSum>
void
AddProduct(TSum & sum, double sign, double x, double y, double z)
{
  const double xy = sign * x * y;
  const double product = xy * z;
  sum.Add(std::fma(xy, z, -product));
  sum.Add(product);
}

/** Adds the determinant of the matrix whose rows are three points. */
template <typename TSum>
void
AddDeterminant(TSum & sum, double sign, const MeshPoint & a, const MeshPoint & b, const MeshPoint & c)
{
  AddProduct(sum, sign, a[0], b[1], c[2]);
  AddProduct(sum, sign, a[1], b[2], c[0]);
  AddProduct(sum, sign, a[2], b[0], c[1]);
  AddProduct(sum, -sign, a[2], b[1], c[0]);
  AddProduct(sum, -sign, a[1], b[0], c[2]);
  AddProduct(sum, -sign, a[0], b[2], c[1]);
}

int
ExactOrientationInSpace(const MeshPoint & a, const MeshPoint & b, const MeshPoint & c, const MeshPoint & d)
{
  ExactSum<48> sum;
  AddDeterminant(sum, 1.0, b, c, d);
  AddDeterminant(sum, -1.0, a, c, d);
  AddDeterminant(sum, 1.0, a, b, d);
  AddDeterminant(sum, -1.0, a, b, c);
  return sum.GetSign();
}

} // namespace

int
OrientationInSpace(const MeshPoint & a, const MeshPoint & b, const MeshPoint & c, const MeshPoint & d)
{
  const double bx = double(b[0]) - a[0], by = double(b[1]) - a[1], bz = double(b[2]) - a[2];
  const double cx = double(c[0]) - a[0], cy = double(c[1]) - a[1], cz = double(c[2]) - a[2];
  const double dx = double(d[0]) - a[0], dy = double(d[1]) - a[1], dz = double(d[2]) - a[2];
  const double determinant = dx * (by * cz - bz * cy) + dy * (bz * cx - bx * cz) + dz * (bx * cy - by * cx);
  const double magnitude = std::abs(dx) * (std::abs(by * cz) + std::abs(bz * cy)) +
                           std::abs(dy) * (std::abs(bz * cx) + std::abs(bx * cz)) +
                           std::abs(dz) * (std::abs(bx * cy) + std::abs(by * cx));
  const int sign = FilteredSign(determinant, magnitude, BoundInSpace);
  return sign != Uncertain ? sign : ExactOrientationInSpace(a, b, c, d);
}

int
OrientationAlongAxis(const MeshPoint & a, const MeshPoint & b, const MeshPoint & c, unsigned int axis)
{
  const unsigned int u = (axis + 1) % 3;
  const unsigned int v = (axis + 2) % 3;
  const double positive = (double(b[u]) - a[u]) * (double(c[v]) - a[v]);
  const double negative = (double(b[v]) - a[v]) * (double(c[u]) - a[u]);
  const int sign = FilteredSign(positive - negative, std::abs(positive) + std::abs(negative), BoundInPlane);
  if (sign != Uncertain)
  {
    return sign;
  }
  ExactSum<6> sum;
  const auto add = [&sum, u, v](const MeshPoint & from, const MeshPoint & to) {
    sum.Add(double(from[u]) * to[v]);
    sum.Add(-double(from[v]) * to[u]);
  };
  add(a, b);
  add(b, c);
  add(c, a);
  return sum.GetSign();
}

bool
HasArea(const MeshPoint & a, const MeshPoint & b, const MeshPoint & c)
{
  return OrientationAlongAxis(a, b, c, 0) != 0 || OrientationAlongAxis(a, b, c, 1) != 0 ||
         OrientationAlongAxis(a, b, c, 2) != 0;
}

} // namespace itk
