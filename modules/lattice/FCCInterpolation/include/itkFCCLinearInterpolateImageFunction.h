#ifndef itkFCCLinearInterpolateImageFunction_h
#define itkFCCLinearInterpolateImageFunction_h

#include "itkFCCImage.h"
#include "itkInterpolateImageFunction.h"

namespace itk
{

/** \class FCCLinearInterpolateImageFunction
 * \brief Linear interpolation in the tetrahedra of an FCC image.
 *
 * The function is continuous within the outermost tetrahedra and reproduces linear fields; a value costs four samples.
 * Within the extent of the buffered region but outside its outermost tetrahedra, the weights of the existing samples
 * are scaled to a sum of 1, so that values stay within the samples' range.
 *
 * Takes an FCCImage; a continuous index is (x / 2, y, z) in lattice coordinates (see FCCImage). Usable as the
 * interpolator of itk::ResampleImageFilter with an FCCImage as its input.
 *
 * \ingroup FCCInterpolation
 */
template <typename TInputImage, typename TCoordRep = double>
class ITK_TEMPLATE_EXPORT FCCLinearInterpolateImageFunction : public InterpolateImageFunction<TInputImage, TCoordRep>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCLinearInterpolateImageFunction);

  using Self = FCCLinearInterpolateImageFunction;
  using Superclass = InterpolateImageFunction<TInputImage, TCoordRep>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCLinearInterpolateImageFunction, InterpolateImageFunction);

  using typename Superclass::ContinuousIndexType;
  using typename Superclass::IndexType;
  using typename Superclass::OutputType;
  using typename Superclass::PointType;
  using typename Superclass::SizeType;

  static_assert(std::is_base_of<FCCImage<typename TInputImage::PixelType>, TInputImage>::value,
                "FCCLinearInterpolateImageFunction interpolates FCCImages only");

  void
  SetInputImage(const TInputImage * image) override;

  OutputType
  EvaluateAtContinuousIndex(const ContinuousIndexType & index) const override;

  /** One sample in each direction. */
  SizeType
  GetRadius() const override
  {
    return SizeType::Filled(1);
  }

protected:
  FCCLinearInterpolateImageFunction() = default;
  ~FCCLinearInterpolateImageFunction() override = default;
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkFCCLinearInterpolateImageFunction.hxx"
#endif

#endif
