#ifndef itkFCCFieldPlanes_h
#define itkFCCFieldPlanes_h

#include "itkFCCFieldKernels.h"
#include "itkFCCSurfaceExtractor.h"

#include <array>
#include <vector>

namespace itk
{

/** \class FCCFieldPlanes
 * \brief Values, coefficients and gradients of the field in a few planes of an FCC image.
 *
 * Sites are counted from a layer of one site around the image, so real ones begin at 1 along each axis. Values are
 * relative to the isovalue. Those of the layer around the image are extrapolated linearly from within, axis by axis.
 * Coefficients are those of the box spline that quasi-interpolates the values, c = 3/2 f - sum of the 12 neighbours
 * / 24 (Kim, Entezari, Peters, "Box spline reconstruction on the face-centered cubic lattice", 2008). The gradient of
 * that box spline at a site is the sum of d c(x + d) / 8 over the neighbours.
 *
 * Planes are computed when asked for, and the last few of each kind are kept: ask in ascending order.
 *
 * Memory: planes of float32, 6 of values, 3 of coefficients and 4 for each of gradients, once they are asked for.
 */
class FCCFieldPlanes
{
public:
  using RowReader = FCCScalarField::RowReader;

  /** \param size of the image, without the layer around it
   *  \param parityOfFirstRow that of the first row of the layer around it
   *  \param readRow reads the image
   *  \param planesOfGradients how many are kept
   *  \param scratch for the planes */
  FCCFieldPlanes(const std::array<SizeValueType, 3> & size,
                 IndexValueType parityOfFirstRow,
                 RowReader readRow,
                 SizeValueType planesOfGradients,
                 std::pmr::memory_resource * scratch);

  IndexValueType
  GetParity(SizeValueType j, SizeValueType k) const
  {
    return (m_ParityOfFirstRow + static_cast<IndexValueType>(j + k)) & 1;
  }

  /** Whether an index along an axis is one of the image, not one of the layer around it. */
  bool
  IsReal(unsigned int axis, SizeValueType index) const
  {
    return index > 0 && index + 1 < m_Size[axis];
  }

  /** Blocks of FCCFieldKernels::Block sites in a row. */
  SizeValueType
  GetNumberOfBlocks() const
  {
    return m_Stride / FCCFieldKernels::Block - 2;
  }

  /** Makes the values of a plane available, and keeps those of the five planes that were loaded before. */
  void
  LoadValues(SizeValueType k);

  /** Makes the values of planes \a k - 1 to \a k + 1 available, of those that exist. */
  void
  LoadValuesAround(SizeValueType k);

  /** Whether the gradients of a plane are available: they have been loaded, and no later plane has overwritten them. */
  bool
  HasGradients(SizeValueType k) const
  {
    return m_Gradients[k % m_Gradients.size()].number == k;
  }

  /** Makes the gradients of a plane available in some blocks of FCCFieldKernels::Block sites, and keeps those of a few
   * planes that were loaded before. \param wanted for each block, row by row: not zero if it is wanted */
  void
  LoadGradients(SizeValueType k, const std::vector<std::uint8_t> & wanted);

  /** Makes the coefficients of planes \a k - 1 to \a k + 1 available. The plane must be one of the image. */
  void
  LoadCoefficientsAround(SizeValueType k);

  /** The gradients of one block of sites, at their positions in a row of \a gradients: GradientStride floats for each
   * site. The coefficients around the plane must have been loaded, and the row be one of the image. */
  void
  ComputeGradients(SizeValueType j, SizeValueType k, SizeValueType block, float * gradients) const;

  /** Floats of a row of gradients, with the margin that kernels need. */
  SizeValueType
  GetLengthOfGradients() const
  {
    return FCCFieldKernels::GradientStride * m_Stride;
  }

  const float *
  GetValues(SizeValueType j, SizeValueType k) const
  {
    return m_Values[k % m_Values.size()].GetRow(j, m_Stride);
  }

  /** A row of gradients, FCCFieldKernels::GradientStride floats for each site. */
  const float *
  GetGradients(SizeValueType j, SizeValueType k) const
  {
    return m_Gradients[k % m_Gradients.size()].GetRow(j, this->GetLengthOfGradients());
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

  void
  LoadCoefficients(SizeValueType k);

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

  void
  GetNeighborRows(const std::vector<Plane> & planes,
                  SizeValueType j,
                  SizeValueType k,
                  FCCFieldKernels::NeighborRows & rows) const;

  std::array<SizeValueType, 3> m_Size; // with the layer around the image
  IndexValueType m_ParityOfFirstRow;
  RowReader m_ReadRow;
  SizeValueType m_Stride;
  std::vector<Plane> m_Values;
  std::vector<Plane> m_Coefficients;
  std::vector<Plane> m_Gradients;
};

} // namespace itk

#endif
