#ifndef itkSliceStack_h
#define itkSliceStack_h

#include "itkImageBase.h"
#include "itkSeparableTaps.h"

#include <array>
#include <vector>

namespace itk
{

/** \class SliceStack
 * \brief The geometry of a volume whose slices are tilted, sheared, or unevenly placed.
 *
 * All slices have the same two in-plane axes, which may enclose any angle; each slice has its own origin. *Frame
 * coordinates* are millimetres from the first slice's first sample along perpendicular axes: x along the image's first
 * axis, y in the plane of the slices, on the side of the second axis, and z along their normal, on the side of the last
 * slice.
 *
 * Slices and samples are counted from the first of the image's largest possible region, whatever its start index.
 *
 * \ingroup FCCResampling
 */
class SliceStack
{
public:
  using PointType = ImageBase<3>::PointType;
  using VectorType = Vector<double, 3>;
  using DirectionType = ImageBase<3>::DirectionType;

  /** \param image gives the in-plane axes, and the slices' origins if \a sliceOrigins is empty; has samples
   *  \param sliceOrigins position of the first sample of each slice, in LPS mm
   *
   * Throws ExceptionObject when the origins are not as many as the slices, or not in order along the normal. */
  SliceStack(const ImageBase<3> & image, const std::vector<PointType> & sliceOrigins);

  /** The frame's axes in the world; left-handed where the image is. */
  const DirectionType &
  GetDirection() const
  {
    return m_Direction;
  }

  /** Distances in mm: from sample to sample along x, from row to row along y, and from slice to slice along z (the
   * median). Their product is the volume per sample. */
  const VectorType &
  GetPitch() const
  {
    return m_Pitch;
  }

  /** The corners of the smallest box, in frame coordinates, that holds the outer faces of all voxels. */
  const VectorType &
  GetLowest() const
  {
    return m_Lowest;
  }
  const VectorType &
  GetHighest() const
  {
    return m_Highest;
  }

  /** From frame coordinates to LPS mm. */
  PointType
  TransformFrameToPoint(const VectorType & frame) const
  {
    return m_Origin + m_Direction * frame;
  }
  /** From LPS mm to frame coordinates. */
  VectorType
  TransformPointToFrame(const PointType & point) const;

  /** The taps over the slices of values at \a heights, z of the frame. Evenly spaced slices are treated like any other
   * axis, others by their true positions. */
  SeparableTaps
  MakeSliceTaps(SeparableKernel kernel, const std::vector<double> & heights) const;

  /** x and y in the frame of sample (0, 0) at height z, the \a n-th position of \a taps. Between slices it is
   * interpolated as the values are; beyond the first and the last slice it is extrapolated linearly from these and
   * their neighbours. */
  std::array<double, 2>
  GetOriginAt(double z, const SeparableTaps & taps, SizeValueType n) const;

  /** Row, in samples, at y of the frame in the plane of that origin. */
  double
  GetRow(double y, const std::array<double, 2> & origin) const
  {
    return (y - origin[1]) / m_Pitch[1];
  }

  /** Position along the row, in samples, at x of the frame. */
  double
  GetColumn(double x, double row, const std::array<double, 2> & origin) const
  {
    return (x - origin[0] - m_RowShift * row) / m_Pitch[0];
  }

  /** Whether rows are shifted against each other along x, because the in-plane axes are not perpendicular. */
  bool
  AreRowsShifted() const
  {
    return m_RowShift != 0.0;
  }

private:
  void
  FindBounds(const Size<3> & size);

  DirectionType m_Direction;
  PointType m_Origin;
  VectorType m_Pitch;
  VectorType m_Lowest;
  VectorType m_Highest;
  double m_RowShift{ 0.0 };               // along x, from row to row, in mm
  bool m_IsEven{ true };                  // whether the slices are evenly spaced and not shifted
  VectorType m_FirstStep;                 // between the first two slices
  VectorType m_LastStep;                  // between the last two slices
  std::vector<VectorType> m_SliceOrigins; // in the frame
  std::vector<double> m_Heights;          // z of the slices' origins
};

} // namespace itk

#endif
