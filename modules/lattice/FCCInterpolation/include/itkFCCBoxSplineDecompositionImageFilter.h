#ifndef itkFCCBoxSplineDecompositionImageFilter_h
#define itkFCCBoxSplineDecompositionImageFilter_h

#include "detail/itkFCCBoxSpline.h"
#include "detail/itkFCCMirror.h"
#include "detail/itkForEachSlab.h"
#include "itkFCCImage.h"
#include "itkImageToImageFilter.h"
#include "itkInputSamples.h"
#include "itkWorkProgress.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace itk
{

/** \class FCCBoxSplineDecompositionImageFilter
 * \brief Computes the coefficients of an FCC image in shifted six-direction box splines, the spline's prefilter.
 *
 * With coefficients c the spline's value at a site is B c = 1/2 c + 1/24 (sum of c at the 12 nearest neighbours). The
 * filter starts from the *quasi-interpolant* c = 2 f - B f = 3/2 f - 1/24 (sum of f) of the samples f, which reproduces
 * quadratic polynomials and costs one pass. Each iteration c <- c + 3/2 (f - B c) then brings the spline's values at
 * the sites nearer to the samples. The eigenvalues of B lie between 1/3 and 1, so each iteration at least halves the
 * difference; after about 20 iterations the spline interpolates within the precision of float.
 *
 * Neighbours outside the image are mirrored at its first and last sites, as in the spline's evaluation: the derivative
 * across the faces of the image is zero.
 *
 * The output has the input's grid. It has the same bytes for any number of threads; arithmetic is in float64. Extra
 * memory: a second output, if there are iterations.
 *
 * The whole input is requested, and the whole output is produced: every iteration makes a coefficient depend on samples
 * one neighbour further away. Throws when the buffer of the input does not hold the whole input.
 *
 * Overridden pipeline methods: GenerateInputRequestedRegion() and EnlargeOutputRequestedRegion() (the whole image).
 *
 * \ingroup FCCInterpolation
 */
template <typename TInputImage, typename TOutputImage = FCCImage<float>>
class ITK_TEMPLATE_EXPORT FCCBoxSplineDecompositionImageFilter : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCBoxSplineDecompositionImageFilter);

  using Self = FCCBoxSplineDecompositionImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCBoxSplineDecompositionImageFilter, ImageToImageFilter);

  using InputPixelType = typename TInputImage::PixelType;
  using CoefficientType = typename TOutputImage::PixelType;

  static_assert(std::is_base_of<FCCImage<InputPixelType>, TInputImage>::value, "The input must be an FCCImage");
  static_assert(std::is_base_of<FCCImage<CoefficientType>, TOutputImage>::value, "The output must be an FCCImage");
  static_assert(std::is_floating_point<CoefficientType>::value, "Coefficients must be real numbers");

  /** Steps from the quasi-interpolant towards interpolation. Default 0: the quasi-interpolant. */
  itkSetMacro(NumberOfIterations, unsigned int);
  itkGetConstMacro(NumberOfIterations, unsigned int);

protected:
  FCCBoxSplineDecompositionImageFilter() = default;
  ~FCCBoxSplineDecompositionImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "NumberOfIterations: " << m_NumberOfIterations << std::endl;
  }

  void
  GenerateInputRequestedRegion() override
  {
    const_cast<TInputImage *>(this->GetInput())->SetRequestedRegionToLargestPossibleRegion();
  }

  void
  EnlargeOutputRequestedRegion(DataObject * output) override
  {
    output->SetRequestedRegionToLargestPossibleRegion();
  }

  void
  GenerateData() override
  {
    VerifyInputSamples(*this, *this->GetInput());
    this->AllocateOutputs();
    const auto & region = this->GetOutput()->GetBufferedRegion();
    WorkProgress progress(*this, (SizeValueType{ m_NumberOfIterations } + 1) * region.GetSize(2));
    constexpr double toQuasiInterpolant = 1.0;
    constexpr double fastest = 1.5; // minimises the largest |1 - gain * eigenvalue|, the error's factor in an iteration

    // Iterations write to two buffers in turn, the last one to the output.
    const std::unique_ptr<CoefficientType[]> spare(
      m_NumberOfIterations > 0 ? new CoefficientType[region.GetNumberOfPixels()] : nullptr);
    CoefficientType * target = this->GetOutput()->GetBufferPointer();
    CoefficientType * previous = spare.get();
    if (m_NumberOfIterations % 2 == 1)
    {
      std::swap(target, previous);
    }
    this->Correct(this->GetInput()->GetBufferPointer(), toQuasiInterpolant, target, progress);
    for (unsigned int iteration = 0; iteration < m_NumberOfIterations; ++iteration)
    {
      std::swap(target, previous);
      this->Correct(previous, fastest, target, progress);
    }
    progress.Finish();
  }

private:
  /** target = coefficients + gain (f - B coefficients) at all sites, on several threads. */
  template <typename TPixel>
  void
  Correct(const TPixel * coefficients, double gain, CoefficientType * target, WorkProgress & progress)
  {
    const auto & region = this->GetOutput()->GetBufferedRegion();
    const InputPixelType * const samples = this->GetInput()->GetBufferPointer();
    const auto width = static_cast<IndexValueType>(region.GetSize(0));
    const auto height = static_cast<IndexValueType>(region.GetSize(1));
    const auto depth = static_cast<IndexValueType>(region.GetSize(2));
    const IndexValueType parityOfFirstRow = FCCLattice::Parity(region.GetIndex(1), region.GetIndex(2));
    const auto correctRow = [=](IndexValueType j, IndexValueType k) {
      const auto rowAt = [=](IndexValueType stepY, IndexValueType stepZ) {
        return coefficients +
               (MirrorIntoRange(k + stepZ, 0, depth - 1) * height + MirrorIntoRange(j + stepY, 0, height - 1)) * width;
      };
      const IndexValueType row = (k * height + j) * width;
      const IndexValueType parity = (parityOfFirstRow + j + k) & 1;
      const TPixel * const sides[4] = { rowAt(-1, 0), rowAt(1, 0), rowAt(0, -1), rowAt(0, 1) };
      const TPixel * const corners[4] = { rowAt(-1, -1), rowAt(1, -1), rowAt(-1, 1), rowAt(1, 1) };
      for (IndexValueType i = 0; i < width; ++i)
      {
        // The neighbours before and after in x; a neighbour beyond an end is mirrored onto the other neighbour.
        const IndexValueType before = std::max<IndexValueType>(i + parity - 1, 0);
        const IndexValueType after = std::min(i + parity, width - 1);
        double sum = 0.0;
        for (unsigned int n = 0; n < 4; ++n)
        {
          sum += static_cast<double>(sides[n][before]) + static_cast<double>(sides[n][after]) +
                 static_cast<double>(corners[n][i]);
        }
        const auto own = static_cast<double>(coefficients[row + i]);
        const double splineAtSite = FCCBoxSpline::AtSite * own + FCCBoxSpline::AtNearestNeighbor * sum;
        target[row + i] =
          static_cast<CoefficientType>(own + gain * (static_cast<double>(samples[row + i]) - splineAtSite));
      }
    };

    ForEachSlab(*this, region.GetSize(2), 1, 1, [&](SizeValueType k, SizeValueType) {
      for (IndexValueType j = 0; j < height; ++j)
      {
        progress.CheckAbort();
        correctRow(j, static_cast<IndexValueType>(k));
      }
      progress.Completed(1);
    });
  }

  unsigned int m_NumberOfIterations{ 0 };
};

} // namespace itk

#endif
