#ifndef itkFCCEdgePoint_h
#define itkFCCEdgePoint_h

#include "itkFCCImage.h"

#include <cmath>

namespace itk
{

/** \class FCCEdgePoint
 * \brief Places the surface's point on a cut edge of an FCC image, and its normal.
 *
 * An edge may lead from a sample to a site outside the image (see FCCIsosurfaceFilter on closed surfaces). The image
 * must be buffered. Thread safe.
 *
 * \ingroup FCCIsosurface
 */
template <typename TInputImage>
class FCCEdgePoint
{
public:
  using SiteType = FCCLattice::SiteType;
  using VectorType = std::array<double, 3>;

  FCCEdgePoint(const TInputImage & image, double isovalue, bool insideIsBelow, double minimumFraction)
    : m_Image(image)
    , m_Region(image.GetBufferedRegion())
    , m_Isovalue(isovalue)
    , m_OutwardSign(insideIsBelow ? 1.0 : -1.0)
    , m_MinimumFraction(minimumFraction)
  {
    // A gradient is a row vector: it goes to the world by the inverse of the matrix that takes lattice steps there.
    for (unsigned int row = 0; row < 3; ++row)
    {
      auto shifted = image.GetOrigin();
      shifted[row] += 1.0;
      const auto column = image.TransformPhysicalPointToLattice(shifted);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        m_GradientToWorld[row][axis] = column[axis];
      }
    }
  }

  /** The point on the edge from a site along a step, and the unit normal there. One end is inside, the other outside.
   */
  void
  Place(const SiteType & site, const SiteType & step, std::array<float, 3> & point, std::array<float, 3> & normal) const
  {
    const SiteType end{ site[0] + step[0], site[1] + step[1], site[2] + step[2] };
    const bool startsOutside = !this->IsSample(site);
    const bool endsOutside = !this->IsSample(end);

    double fraction = 0.5;
    VectorType outwards; // a normal in lattice coordinates, of any length
    if (startsOutside || endsOutside)
    {
      const SiteType inwardStep{ -step[0], -step[1], -step[2] };
      const double toBorder =
        startsOutside ? this->FractionToBorder(end, inwardStep) : this->FractionToBorder(site, step);
      fraction = startsOutside ? 1.0 - toBorder : toBorder;
      outwards = this->BorderDirection(startsOutside ? site : end);
    }
    else
    {
      fraction = this->CrossingFraction(this->ValueAt(site), this->ValueAt(end));
      const VectorType atSite = this->GradientAt(site);
      const VectorType atEnd = this->GradientAt(end);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        outwards[axis] = m_OutwardSign * ((1.0 - fraction) * atSite[axis] + fraction * atEnd[axis]);
      }
      if (!IsUsable(outwards))
      {
        // A flat or undefined neighbourhood: the values change along the edge at least.
        const double sign = this->ValueAt(site) >= m_Isovalue ? -m_OutwardSign : m_OutwardSign;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          outwards[axis] = sign * static_cast<double>(step[axis]);
        }
      }
    }

    VectorType coordinates;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      coordinates[axis] = static_cast<double>(site[axis]) + fraction * static_cast<double>(step[axis]);
    }
    const auto world = m_Image.template TransformLatticeToPhysicalPoint<double>(coordinates);
    VectorType worldNormal{};
    double squared = 0.0;
    for (unsigned int row = 0; row < 3; ++row)
    {
      point[row] = static_cast<float>(world[row]);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        worldNormal[row] += m_GradientToWorld[row][axis] * outwards[axis];
      }
      squared += worldNormal[row] * worldNormal[row];
    }
    for (unsigned int row = 0; row < 3; ++row)
    {
      normal[row] = static_cast<float>(worldNormal[row] / std::sqrt(squared));
    }
  }

private:
  bool
  IsSample(const SiteType & site) const
  {
    return m_Region.IsInside(FCCLattice::IndexOf(site));
  }

  double
  ValueAt(const SiteType & site) const
  {
    return static_cast<double>(m_Image.GetPixel(FCCLattice::IndexOf(site)));
  }

  double
  CrossingFraction(double atSite, double atEnd) const
  {
    const double fraction = (m_Isovalue - atSite) / (atEnd - atSite);
    if (!std::isfinite(fraction)) // an infinite value or not-a-number at one of the ends
    {
      return 0.5;
    }
    return std::min(std::max(fraction, m_MinimumFraction), 1.0 - m_MinimumFraction);
  }

  /** How far along a step that leaves the image its extent ends. */
  double
  FractionToBorder(const SiteType & site, const SiteType & step) const
  {
    constexpr double unitsPerIndex[3] = { 2.0, 1.0, 1.0 };
    double nearest = 1.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double begin = unitsPerIndex[axis] * static_cast<double>(m_Region.GetIndex(axis)) - 0.5;
      const double end = begin + unitsPerIndex[axis] * static_cast<double>(m_Region.GetSize(axis));
      const double border = step[axis] > 0 ? end : begin;
      if (step[axis] != 0)
      {
        nearest = std::min(nearest, (border - static_cast<double>(site[axis])) / static_cast<double>(step[axis]));
      }
    }
    return nearest;
  }

  /** Across the faces of the extent beyond which a site outside the image lies. */
  VectorType
  BorderDirection(const SiteType & outside) const
  {
    const auto index = FCCLattice::IndexOf(outside);
    VectorType direction{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      direction[axis] = index[axis] < m_Region.GetIndex(axis)          ? -1.0
                        : index[axis] > m_Region.GetUpperIndex()[axis] ? 1.0
                                                                       : 0.0;
    }
    return direction;
  }

  /** Gradient in lattice coordinates from the twelve neighbours. Where one of two opposite neighbours is missing, its
   * value is extrapolated from the other; where both are, their direction adds nothing. */
  VectorType
  GradientAt(const SiteType & site) const
  {
    constexpr unsigned int directions = 6; // the other six are their opposites
    VectorType gradient{};
    for (unsigned int n = 0; n < directions; ++n)
    {
      const SiteType & d = FCCLattice::NearestNeighbors[n];
      const SiteType ahead{ site[0] + d[0], site[1] + d[1], site[2] + d[2] };
      const SiteType behind{ site[0] - d[0], site[1] - d[1], site[2] - d[2] };
      const bool hasAhead = this->IsSample(ahead);
      const bool hasBehind = this->IsSample(behind);
      double difference = 0.0;
      if (hasAhead && hasBehind)
      {
        difference = this->ValueAt(ahead) - this->ValueAt(behind);
      }
      else if (hasAhead)
      {
        difference = 2.0 * (this->ValueAt(ahead) - this->ValueAt(site));
      }
      else if (hasBehind)
      {
        difference = 2.0 * (this->ValueAt(site) - this->ValueAt(behind));
      }
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        gradient[axis] += static_cast<double>(d[axis]) * difference / 8.0;
      }
    }
    return gradient;
  }

  static bool
  IsUsable(const VectorType & gradient)
  {
    const double squared = gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2];
    return squared > 0.0 && std::isfinite(squared);
  }

  const TInputImage & m_Image;
  typename TInputImage::RegionType m_Region;
  double m_Isovalue;
  double m_OutwardSign; ///< of the gradient, to point outside
  double m_MinimumFraction;
  double m_GradientToWorld[3][3];
};

} // namespace itk

#endif
