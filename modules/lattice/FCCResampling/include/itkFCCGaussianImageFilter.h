#ifndef itkFCCGaussianImageFilter_h
#define itkFCCGaussianImageFilter_h

#include "detail/itkFCCGaussianTaps.h"
#include "detail/itkProduceOutput.h"
#include "detail/itkRowArithmetic.h"
#include "detail/itkRowPasses.h"
#include "itkFCCImage.h"
#include "itkFCCResamplingChecks.h"
#include "itkImageToImageFilter.h"
#include "itkWorkProgress.h"
#include "rhombicPixelTypes.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace itk
{

/** \class FCCGaussianImageFilter
 * \brief Smooths an FCC image with a Gaussian that is isotropic in millimetres.
 *
 * Sigma is the standard deviation along each axis, whatever the lattice's spacing. Weights are those of a sampled
 * Gaussian, cut off beyond four standard deviations, with exact second moments for every Sigma and spacing: linear
 * fields do not change, quadratic fields change by Sigma^2 / 2 times their Laplacian, and the isosurface of a sphere of
 * radius R in a smooth field is moved inwards by about Sigma^2 / R for a sharp edge. Where slices are much farther
 * apart than Sigma, neighbouring slices get the small weights that make this true. An image one sample thick along y or
 * z is not smoothed along it.
 *
 * Sites outside the image are mirrored at its first and last sites, as the splines of FCCInterpolation do: the
 * derivative across the faces of the image is zero.
 *
 * Samples that are not finite do not enter the averages of the others and do not change. Integer outputs are rounded
 * half away from zero. Arithmetic is in float32, which is exact enough for 16-bit pixels to preserve constants, and
 * good for 7 digits of wider ones. With Sigma 0 the output is a copy of the input.
 *
 * The Gaussian is a product of one factor per axis, and the sum over the even points of the lattice one of sums over
 * even and odd points along each axis: along y, rows are blended into sums over the even and over the odd steps, which
 * are rows of both parities; then both along z; then along x into the row of sites. Each is a pass over whole rows,
 * with 4 (2 reach + 1) products per site in all. Extra memory: that of the rows of one block of planes, 1 MiB per
 * thread, or 16 rows of float for each plane within reach, if that is more. Any part of the output has the same bytes
 * whether it is computed alone or with the rest, by one thread or many, on any processor. Samples that are not finite
 * double the time.
 *
 * The axes must be perpendicular, as in all outputs of this module's filters. The filter requests only the part
 * of the input that the requested output needs.
 *
 * Throws when Sigma is negative, not finite, or more than about a thousand times the spacing, when the axes are not
 * perpendicular, and when the input's buffer lacks samples that are needed.
 *
 * Overridden pipeline methods: VerifyPreconditions() (Sigma in range), VerifyInputInformation() (perpendicular axes,
 * Sigma in proportion to the spacing), GenerateInputRequestedRegion() (the reach), GenerateData() (work is divided
 * along y, not z, because blocks of rows share the planes within reach).
 *
 * \ingroup FCCResampling
 */
template <typename TInputImage, typename TOutputImage = TInputImage>
class ITK_TEMPLATE_EXPORT FCCGaussianImageFilter : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCGaussianImageFilter);

  using Self = FCCGaussianImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCGaussianImageFilter, ImageToImageFilter);

  using InputPixelType = typename TInputImage::PixelType;
  using OutputPixelType = typename TOutputImage::PixelType;
  using RegionType = typename TOutputImage::RegionType;

  static_assert(std::is_base_of<FCCImage<InputPixelType>, TInputImage>::value, "The input must be an FCCImage");
  static_assert(std::is_base_of<FCCImage<OutputPixelType>, TOutputImage>::value, "The output must be an FCCImage");
  static_assert(std::is_integral<InputPixelType>::value || std::is_floating_point<OutputPixelType>::value,
                "Samples that are not finite can't be stored in an integer output");

  /** Standard deviation in mm, at least 0. Default 0: the output is a copy. */
  itkSetMacro(Sigma, double);
  itkGetConstMacro(Sigma, double);

protected:
  FCCGaussianImageFilter() = default;
  ~FCCGaussianImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "Sigma: " << m_Sigma << std::endl;
  }

  void
  VerifyPreconditions() ITKv5_CONST override
  {
    Superclass::VerifyPreconditions();
    if (!(m_Sigma >= 0.0) || !std::isfinite(m_Sigma))
    {
      itkExceptionMacro("Sigma must be a number of mm from 0 on, not " << m_Sigma << "; try 1.");
    }
  }

  void
  VerifyInputInformation() ITKv5_CONST override
  {
    Superclass::VerifyInputInformation();
    if (!AreAxesPerpendicular(this->GetInput()->GetDirection()))
    {
      itkExceptionMacro(
        "The lattice's axes are not perpendicular, so that no Gaussian on it is isotropic; resample the "
        "scan with CartesianToFCCImageFilter, whose lattices are.");
    }
    const auto variances = this->GetVariances();
    const double reach = 4.0 * std::sqrt(*std::max_element(variances.begin(), variances.end()));
    if (!(reach <= FCCGaussianTaps::MaximumReach))
    {
      itkExceptionMacro("A Sigma of " << m_Sigma << " mm is out of proportion to the lattice's spacing of "
                                      << this->GetInput()->GetSpacing() << " mm; use at most "
                                      << m_Sigma * FCCGaussianTaps::MaximumReach / reach << '.');
    }
  }

  void
  GenerateInputRequestedRegion() override
  {
    Superclass::GenerateInputRequestedRegion();
    if (m_Sigma > 0.0)
    {
      auto * const input = const_cast<TInputImage *>(this->GetInput());
      const FCCGaussianTaps taps(this->GetVariances());
      input->SetRequestedRegion(
        taps.AddReach(this->GetOutput()->GetRequestedRegion(), input->GetLargestPossibleRegion()));
    }
  }

  void
  GenerateData() override
  {
    this->AllocateOutputs();
    const FCCGaussianTaps taps(this->GetVariances());
    constexpr unsigned int undivided = 2; // blocks of rows share the planes within reach
    ProduceOutput(*this, undivided, [&](const RegionType & region, WorkProgress::Share & progress) {
      m_Sigma > 0.0 ? this->Smooth(region, taps, progress) : this->Copy(region, progress);
    });
  }

private:
  /** The variance along each axis in lattice units squared. */
  std::array<double, 3>
  GetVariances() const
  {
    const TInputImage * const input = this->GetInput();
    std::array<double, 3> variances{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      // Rows hold samples of one parity; other axes need two planes for that.
      if (axis == 0 || input->GetLargestPossibleRegion().GetSize(axis) > 1)
      {
        const double unit =
          input->GetSpacing()[axis] * input->GetDirection().GetVnlMatrix().get_column(axis).magnitude();
        variances[axis] = m_Sigma * m_Sigma / (unit * unit);
      }
    }
    return variances;
  }

  const InputPixelType *
  GetInputRow(const Index<3> & start) const
  {
    return this->GetInput()->GetBufferPointer() + this->GetInput()->ComputeOffset(start);
  }

  void
  Copy(const RegionType & region, WorkProgress::Share & progress)
  {
    TOutputImage * const output = this->GetOutput();
    const auto end = region.GetIndex() + region.GetSize();
    auto index = region.GetIndex();
    for (; index[2] < end[2]; ++index[2])
    {
      for (index[1] = region.GetIndex(1); index[1] < end[1]; ++index[1])
      {
        const InputPixelType * const row = this->GetInputRow(index);
        std::transform(row,
                       row + region.GetSize(0),
                       output->GetBufferPointer() + output->ComputeOffset(index),
                       [](auto value) { return static_cast<OutputPixelType>(value); });
        progress.Completed(region.GetSize(0));
      }
    }
  }

  void
  Smooth(const RegionType & region, const FCCGaussianTaps & taps, WorkProgress::Share & progress)
  {
    TOutputImage * const output = this->GetOutput();
    bool isAllFinite = true;
    SmoothRows(
      taps,
      this->GetInput()->GetLargestPossibleRegion(),
      region,
      [&](const Index<3> & start, SizeValueType length, float * row) {
        progress.CheckAbort();
        RowArithmetic::ConvertFrom(this->GetInputRow(start), length, row);
        if constexpr (std::is_floating_point<InputPixelType>::value)
        {
          for (SizeValueType n = 0; n < length; ++n)
          {
            const bool isFinite = std::isfinite(row[n]);
            isAllFinite = isAllFinite && isFinite;
            row[n] = isFinite ? row[n] : 0.0f;
          }
        }
      },
      [&](const Index<3> & start, SizeValueType length, const float * values) {
        RowArithmetic::RoundTo(values, length, output->GetBufferPointer() + output->ComputeOffset(start));
        progress.Completed(length);
      });
    if constexpr (std::is_floating_point<InputPixelType>::value)
    {
      if (!isAllFinite)
      {
        this->AverageFiniteSamples(region, taps, progress);
      }
    }
  }

  /** Divides smoothed samples by the sum of the weights of the finite samples they were made of. Samples that are not
   * finite themselves get their old values. */
  void
  AverageFiniteSamples(const RegionType & region, const FCCGaussianTaps & taps, WorkProgress::Share & progress)
  {
    const RegionType & whole = this->GetInput()->GetLargestPossibleRegion();
    TOutputImage * const output = this->GetOutput();
    float allWeights = 0.0f; // where all samples within reach are finite: these sums are divided by exactly 1
    SmoothRows(
      taps,
      whole,
      { region.GetIndex(), { { 1, 1, 1 } } },
      [](const Index<3> &, SizeValueType length, float * row) { std::fill_n(row, length, 1.0f); },
      [&](const Index<3> &, SizeValueType, const float * values) { allWeights = values[0]; });
    SmoothRows(
      taps,
      whole,
      region,
      [&](const Index<3> & start, SizeValueType length, float * row) {
        progress.CheckAbort();
        const InputPixelType * const samples = this->GetInputRow(start);
        std::transform(samples, samples + length, row, [](auto value) { return std::isfinite(value) ? 1.0f : 0.0f; });
      },
      [&](const Index<3> & start, SizeValueType length, const float * weights) {
        const InputPixelType * const own = this->GetInputRow(start);
        OutputPixelType * const row = output->GetBufferPointer() + output->ComputeOffset(start);
        for (SizeValueType n = 0; n < length; ++n)
        {
          row[n] = static_cast<OutputPixelType>(std::isfinite(own[n]) ? row[n] / (weights[n] / allWeights) : own[n]);
        }
      });
  }

  double m_Sigma{ 0.0 };
};

// Compiled once, in the library, for the pixel types of scans.
RHOMBIC_INSTANTIATE(extern template class FCCGaussianImageFilter, FCCImage);

} // namespace itk

#endif
