#ifndef itkFCCLinearInterpolateImageFunction_h
#define itkFCCLinearInterpolateImageFunction_h

#include "detail/itkFCCTetrahedron.h"
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
  SetInputImage(const TInputImage * image) override
  {
    Superclass::SetInputImage(image);
    if (image != nullptr)
    {
      // The extent along x is half a lattice unit, a quarter of an index, around the even and odd rows' samples.
      this->m_StartContinuousIndex[0] += static_cast<TCoordRep>(0.25);
      this->m_EndContinuousIndex[0] += static_cast<TCoordRep>(0.25);
    }
  }

  OutputType
  EvaluateAtContinuousIndex(const ContinuousIndexType & index) const override
  {
    const TInputImage * const image = this->GetInputImage();
    const std::array<double, 3> point{ 2.0 * index[0], static_cast<double>(index[1]), static_cast<double>(index[2]) };
    const FCCTetrahedron tetrahedron = LocateFCCTetrahedron(point);

    double sum = 0.0;
    double weight = 0.0;
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      const IndexType site = FCCLattice::IndexOf(tetrahedron.sites[corner]);
      if (tetrahedron.weights[corner] > 0.0 && this->IsInsideBuffer(site))
      {
        sum += tetrahedron.weights[corner] * static_cast<double>(image->GetPixel(site));
        weight += tetrahedron.weights[corner];
      }
    }
    if (weight > 0.0)
    {
      return static_cast<OutputType>(sum / weight);
    }
    IndexType nearest = FCCLattice::IndexOf(FCCLattice::NearestSite(point));
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      nearest[axis] = std::min(std::max(nearest[axis], this->m_StartIndex[axis]), this->m_EndIndex[axis]);
    }
    return static_cast<OutputType>(image->GetPixel(nearest));
  }

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

#endif
