#ifndef itkAntiAliasMaskImageFilter_h
#define itkAntiAliasMaskImageFilter_h

#include "itkImage.h"
#include "itkBulkAllocator.h"
#include "itkImageToImageFilter.h"

#include <array>
#include <functional>
#include <cstdint>

namespace itk
{

/** \class AntiAliasMaskImageFilter
 * \brief A smooth field whose zero surface is the border of a mask, without the steps of its voxels.
 *
 * Input voxels other than 0 are inside. The output is the approximate depth below the border in voxels, positive
 * inside; beyond 3 voxels it has no meaning.
 *
 * Smoothing a mask moves its border inwards where it is convex, and small parts vanish. Methods that keep each voxel in
 * its class (R. Whitaker, "Reducing aliasing artifacts in iso-surfaces of binary volumes", 2000, and
 * itk::AntiAliasBinaryImageFilter) leave steps. This filter keeps the **local volume**: with G a Gaussian of 2.5
 * voxels, the field f starts as the smoothed mask and gets Newton's corrections
 *
 *   f += (2 pi)^(1/2) 2.5  G * (mask - coverage(f)),   coverage(f) = min(1, max(0, f + 1/2)),
 *
 * until the smoothed coverage of the voxels is that of the mask. The border then stays in place on average, and its
 * steps vanish.
 *
 * Thin parts and sharp edges need a smaller neighbourhood. Around voxels that end up more than 0.2 on the wrong side,
 * the field is made with a Gaussian of 1.2 voxels and smaller corrections. *Narrow* voxels are those that are still
 * more than 0.3 on the wrong side, or on it at all if they are of sheets and vessels one voxel wide: sixteen or more
 * connected voxels in no 2 x 2 x 2 block of their class. Around them the Gaussian is one of 1 voxel. Voxels in no such
 * block that are still on the wrong side are *protected*: the field is at least that of a tube of radius 0.6 around
 * them and their connections with all 26 neighbours of their class. So vessels of one voxel and single voxels stay.
 * *Spurs* do not: one or two such voxels that stick out of a part and connect it with nothing. A part as narrow as a
 * voxel may become thinner than a lattice of the default density resolves, and then has gaps.
 *
 * Mean errors against the shape that the mask was made from: distance in voxels, angle of facets in degrees, and area
 * in per cent, of the zero surface extracted from the default lattice; for spheres of radius 10 and 40, a torus
 * (25, 7.3), and a box of 44 turned by 17 degrees (distance and angle of its faces). All were extracted at the level
 * that has the mask's volume. Last column: error of the volume of the first sphere at level 0, in per cent.
 *
 *     method                              sphere 10       sphere 40       torus           box             volume
 *     this filter                         .035  1.4 0.0   .029  1.1 0.0   .034  1.9 0.1   .05  0.9 -1.8    -0.2
 *     mask smoothed by a Gaussian of 2    .028  1.2 0.0   .023  0.9 0.0   .056  1.8 -.1   .16  0.8 -6.6   -11.5
 *     AntiAliasBinaryImageFilter, 0.07    .097 11.8 2.8   .098 11.6 2.7   .102 11.8 2.7   .12 14.5  2.7    -0.8
 *     the same, RMS error 0.01            .058  4.2 0.3   .068  4.9 0.5   .069  4.3 0.3   .08  5.2 -2.1    -4.3
 *     Whitaker's, 8 times a Gaussian of 1 .084 13.6 3.5   .035  4.0 0.4   .080 10.8 2.3   .13  0.9 -1.7   -11.3
 *
 * **Thick slices.** With SetSamplePeriod() only the voxels whose index is a multiple of the period along each axis are
 * samples of the shape; the voxels between them, which should have the class of the nearest sample, only count for thin
 * parts. The corrections then match samples alone, G being normalized by the samples in its reach, so that the field
 * between slices is the smooth one that agrees with the slices around it, and has no terraces. All Gaussians are wider
 * by 0.3 times the longest period if that is more than 1.
 *
 * The field is computed within 5 voxels of the border, times the factor by which all Gaussians are wider; beyond, it
 * has the value of a smoothed mask far from borders, 3.13 or -3.13 times that factor. The smaller Gaussians are used
 * only around the voxels that need them. So time grows with the area of the border.
 *
 * Inside and outside are treated alike, except where tubes of both touch, so that the masks on both sides of a wall get
 * the same wall. Distances are in voxels, whatever their spacing. Beyond the image the mask continues as it is at the
 * border; leave a margin of 4 voxels around it, except where the scan ends.
 *
 * Requests the whole input and makes the whole output, because sheets, vessels and spurs are connected parts of any
 * size. The output has the same bytes for any number of threads, on any processor. Extra memory: 11 bytes per voxel,
 * of which 8 are touched near the border only. Throws when the input's buffer is not whole.
 *
 * \ingroup LabelSurfaces
 */
class AntiAliasMaskImageFilter : public ImageToImageFilter<Image<std::uint8_t, 3>, Image<float, 3>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(AntiAliasMaskImageFilter);

  using Self = AntiAliasMaskImageFilter;
  using Superclass = ImageToImageFilter<Image<std::uint8_t, 3>, Image<float, 3>>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(AntiAliasMaskImageFilter, ImageToImageFilter);

  /** Whether sheets and vessels one voxel wide are not protected, for users that keep them whole by GetThinVoxels():
   * they are smoother then. Default off. */
  itkSetMacro(ProtectSpecksOnly, bool);
  itkGetConstMacro(ProtectSpecksOnly, bool);
  itkBooleanMacro(ProtectSpecksOnly);

  using PeriodType = std::array<SizeValueType, 3>;

  /** Distance of the samples along each axis, in voxels; at least 1. Default 1: each voxel is a sample. */
  void
  SetSamplePeriod(const PeriodType & period);
  const PeriodType &
  GetSamplePeriod() const
  {
    return m_SamplePeriod;
  }

  /** By what all Gaussians are wider than those of samples at each voxel. */
  static double
  FindWidening(const PeriodType & period);

  using NeededType = std::function<bool(const Index<3> & first, SizeValueType length)>;

  /** Tells whether the field is needed at some of \a length voxels of a row, of which \a first is the first. Where it
   * is not, the values are those far from the border, on the mask's side, and no voxels are protected. Called by one
   * thread at a time. Default: none, the field is needed everywhere. */
  void
  SetNeeded(NeededType isNeeded);

  /** The inside voxels in no 2 x 2 x 2 block of inside voxels, and the inside and outside voxels that were protected in
   * the last update, by their offsets in the buffer, ascending. */
  const BulkVector<SizeValueType> &
  GetThinVoxels() const
  {
    return m_ThinVoxels;
  }
  const BulkVector<SizeValueType> &
  GetProtectedVoxels() const
  {
    return m_ProtectedVoxels;
  }
  const BulkVector<SizeValueType> &
  GetProtectedOutsideVoxels() const
  {
    return m_ProtectedOutsideVoxels;
  }

protected:
  AntiAliasMaskImageFilter() = default;
  ~AntiAliasMaskImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  GenerateInputRequestedRegion() override;

  void
  EnlargeOutputRequestedRegion(DataObject * output) override;

  void
  GenerateData() override;

private:
  PeriodType m_SamplePeriod{ { 1, 1, 1 } };
  bool m_ProtectSpecksOnly{ false };
  BulkVector<SizeValueType> m_ThinVoxels;
  BulkVector<SizeValueType> m_ProtectedVoxels;
  BulkVector<SizeValueType> m_ProtectedOutsideVoxels;
  NeededType m_IsNeeded;
};

} // namespace itk

#endif
