#ifndef itkQuadric_h
#define itkQuadric_h

#include "detail/itkPositionArithmetic.h"

#include <algorithm>
#include <cmath>

namespace itk
{

/** \class Quadric
 * \brief The sum of weighted squared distances from planes, as a function of position: Garland and Heckbert, "Surface
 * simplification using quadric error metrics" (SIGGRAPH 1997). */
class Quadric
{
public:
  /** Adds the plane through a position, weighted by the length of \a normal. */
  void
  AddPlane(const PositionType & position, const PositionType & normal)
  {
    const double weight = Length(normal);
    if (!(weight > 0.0))
    {
      return;
    }
    const PositionType n{ normal[0] / weight, normal[1] / weight, normal[2] / weight };
    const double d = -Dot(n, position);
    const std::array<double, 11> terms{ n[0] * n[0], n[1] * n[1], n[2] * n[2], n[0] * n[1], n[0] * n[2], n[1] * n[2],
                                        n[0] * d,    n[1] * d,    n[2] * d,    d * d,       1.0 };
    for (std::size_t i = 0; i < terms.size(); ++i)
    {
      m_Terms[i] += weight * terms[i];
    }
  }

  void
  Add(const Quadric & other)
  {
    for (std::size_t i = 0; i < m_Terms.size(); ++i)
    {
      m_Terms[i] += other.m_Terms[i];
    }
  }

  /** Root of the weighted mean squared distance. */
  double
  ComputeDistance(const PositionType & p) const
  {
    const auto & t = m_Terms;
    const double sum =
      t[0] * p[0] * p[0] + t[1] * p[1] * p[1] + t[2] * p[2] * p[2] +
      2.0 * (t[3] * p[0] * p[1] + t[4] * p[0] * p[2] + t[5] * p[1] * p[2] + t[6] * p[0] + t[7] * p[1] + t[8] * p[2]) +
      t[9];
    return t[10] > 0.0 ? std::sqrt(std::max(0.0, sum) / t[10]) : 0.0;
  }

  /** The position of least distance. It stays near \a middle along directions in which the distance hardly changes. */
  PositionType
  FindMinimum(const PositionType & middle) const
  {
    constexpr double Pull = 1e-3; // towards the middle, relative to the planes' weight
    const auto & t = m_Terms;
    const double pull = Pull * t[10];
    const PositionType x{ t[0] + pull, t[3], t[4] };
    const PositionType y{ t[3], t[1] + pull, t[5] };
    const PositionType z{ t[4], t[5], t[2] + pull };
    const PositionType slope{ Dot({ t[0], t[3], t[4] }, middle) + t[6],
                              Dot({ t[3], t[1], t[5] }, middle) + t[7],
                              Dot({ t[4], t[5], t[2] }, middle) + t[8] };
    const double determinant = Dot(x, Cross(y, z)); // Cramer's rule; the matrix is symmetric and positive definite
    if (!(determinant > 0.0))
    {
      return middle;
    }
    return { middle[0] - Dot(slope, Cross(y, z)) / determinant,
             middle[1] - Dot(slope, Cross(z, x)) / determinant,
             middle[2] - Dot(slope, Cross(x, y)) / determinant };
  }

private:
  std::array<double, 11> m_Terms{}; ///< coefficients of xx yy zz xy xz yz x y z 1, and the sum of the weights
};

} // namespace itk

#endif
