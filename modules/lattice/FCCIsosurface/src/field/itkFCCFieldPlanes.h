#ifndef itkFCCFieldPlanes_h
#define itkFCCFieldPlanes_h

#include "detail/itkFCCBitRows.h"
#include "itkFCCSurfaceExtractor.h"

#include <array>
#include <utility>
#include <vector>

namespace itk
{

/** \class FCCFieldKernels
 * \brief The loops over rows of a field, compiled for several instruction sets; the best for the processor runs,
 * and results have the same bits whichever does.
 */
struct FCCFieldKernels
{
  /** Sites of a block: rows can be read and written in whole blocks, a margin of one block beyond both ends. */
  static constexpr SizeValueType Block = 16;

  /** The twelve neighbours' rows of a row of sites, shifted so that element i is the neighbour of site i, in the order
   * of FCCLattice::NearestNeighbors. */
  using NeighborRows = std::array<const float *, 12>;

  /** Coefficients of the box spline that quasi-interpolates a row of values: 3/2 f - sum of neighbours / 24. Where that
   * is not finite, the value itself. Whole blocks are computed. */
  static void
  QuasiInterpolate(const float * values, const NeighborRows & neighbors, SizeValueType count, float * coefficients);

  /** Floats that a gradient takes in memory: x, y, z and nothing, so that it is read at once. */
  static constexpr SizeValueType GradientStride = 4;

  /** The gradients at some sites of a row in lattice coordinates, sum of d f(x + d) / 8 over the neighbours, one after
   * the other. \param sites \a words words, whose bits are the sites that are wanted */
  static void
  Gradient(const NeighborRows & neighbors, const std::uint64_t * sites, SizeValueType words, float * gradients);
};

/** \class FCCFieldPlanes
 * \brief Values, coefficients and gradients of the field in a few planes of an FCC image.
 *
 * Sites are counted from a layer of one site around the image, so the image's sites begin at 1 along each axis. Values
 * are relative to the isovalue. Values of the layer around the image are extrapolated linearly from within, axis by
 * axis. Coefficients are those of the box spline that quasi-interpolates the values, c = 3/2 f - sum of the 12
 * neighbours / 24 (Kim, Entezari, Peters, "Box spline reconstruction on the face-centered cubic lattice", 2008). The
 * gradient of that box spline at a site is the sum of d c(x + d) / 8 over the neighbours. Only sites that have a
 * neighbour on the other side of the surface have gradients, which are stored one after the other: the gradients of a
 * few planes fit into a cache.
 *
 * Planes are computed when asked for, and the last few of each kind are kept: ask in ascending order.
 *
 * Memory: planes of float32, 6 of values and 3 of coefficients, and 16 bytes for each gradient, once they are asked
 * for.
 */
class FCCFieldPlanes
{
public:
  using RowReader = FCCScalarField::RowReader;

  /** \param signs of the field's samples, with or without the layer around the image; must outlive this
   *  \param planesOfGradients how many are kept */
  FCCFieldPlanes(const FCCSigns & signs, const FCCScalarField & field, SizeValueType planesOfGradients);

  IndexValueType
  GetParity(SizeValueType j, SizeValueType k) const
  {
    return (m_ParityOfFirstRow + static_cast<IndexValueType>(j + k)) & 1;
  }

  /** Whether an index along an axis is in the image, not in the layer around it. */
  bool
  IsReal(unsigned int axis, SizeValueType index) const
  {
    return index > 0 && index + 1 < m_Size[axis];
  }

  /** Makes the values of a plane available, and keeps the values of the five planes that were loaded before. */
  void
  LoadValues(SizeValueType k);

  /** Makes the values of the planes \a k - 1 to \a k + 1 available, as far as they exist. */
  void
  LoadValuesAround(SizeValueType k);

  /** Makes the gradients of a plane available, and keeps the gradients of a few planes that were loaded before. Planes
   * of the layer around the image have no gradients. */
  void
  LoadGradients(SizeValueType k);

  const float *
  GetValues(SizeValueType j, SizeValueType k) const
  {
    return m_Values[k % m_Values.size()].GetRow(j, m_Stride);
  }

  /** The values at a step from the sites of a row: element i belongs to the row's site i. */
  const float *
  GetValues(SizeValueType j, SizeValueType k, const FCCLattice::SiteType & step) const
  {
    return this->GetRow(m_Values, j, k, step);
  }

  /** The gradients of a row. */
  struct GradientRow
  {
    FCCNumberedBits::Row sites;
    const float * gradients; ///< by number of the site, FCCFieldKernels::GradientStride floats for each

    /** The gradient at a site, which must have a neighbour on the other side of the surface. */
    const float *
    GetGradient(SizeValueType i) const
    {
      return gradients + FCCFieldKernels::GradientStride * sites.GetNumber(i);
    }
  };

  /** The gradients of a row of the image. Those of its plane must have been loaded. */
  GradientRow
  GetGradients(SizeValueType j, SizeValueType k) const
  {
    const GradientPlane & plane = m_Gradients[k % m_Gradients.size()];
    return { plane.sites.GetNumberedRow(j), plane.gradients.data() };
  }

private:
  struct Plane
  {
    static constexpr SizeValueType None = ~SizeValueType{ 0 };

    SizeValueType number = None;
    std::pmr::vector<float> samples;

    explicit Plane(std::pmr::memory_resource * scratch)
      : samples(scratch)
    {}

    float *
    GetRow(SizeValueType j, SizeValueType stride)
    {
      return samples.data() + j * stride + FCCFieldKernels::Block;
    }
    const float *
    GetRow(SizeValueType j, SizeValueType stride) const
    {
      return samples.data() + j * stride + FCCFieldKernels::Block;
    }
  };

  struct GradientPlane
  {
    SizeValueType number = Plane::None;
    FCCNumberedBits sites;
    std::vector<float> gradients;

    explicit GradientPlane(FCCNumberedBits && noSites)
      : sites(std::move(noSites))
    {}
  };

  void
  LoadCoefficients(SizeValueType k);

  /** Finds the sites of a plane that have gradients. */
  void
  FindSites(SizeValueType k, FCCNumberedBits & sites) const;

  /** Makes a plane available: fill(plane) writes the sites of the image, the layer around it is extrapolated. */
  template <typename TFill>
  void
  LoadPlane(std::vector<Plane> & planes, SizeValueType k, const TFill & fill) const;

  void
  ExtrapolateWithin(Plane & plane, SizeValueType k) const;

  void
  ExtrapolatePlane(std::vector<Plane> & planes, SizeValueType k) const;

  void
  ExtrapolateRow(const float * near, const float * far, IndexValueType parity, float * row) const;

  const float *
  GetRow(const std::vector<Plane> & planes, SizeValueType j, SizeValueType k, const FCCLattice::SiteType & step) const
  {
    const auto offset = FCCLattice::OffsetOf(step, this->GetParity(j, k));
    const SizeValueType plane = k + static_cast<SizeValueType>(offset[2]);
    return planes[plane % planes.size()].GetRow(j + static_cast<SizeValueType>(offset[1]), m_Stride) + offset[0];
  }

  FCCFieldKernels::NeighborRows
  GetNeighborRows(const std::vector<Plane> & planes, SizeValueType j, SizeValueType k) const;

  const FCCSigns & m_Signs;
  std::array<SizeValueType, 3> m_Size; // with the layer around the image
  IndexValueType m_ParityOfFirstRow;
  RowReader m_ReadRow;
  SizeValueType m_Stride;
  std::vector<Plane> m_Values;
  std::vector<Plane> m_Coefficients;
  std::vector<GradientPlane> m_Gradients;
};

} // namespace itk

#endif
