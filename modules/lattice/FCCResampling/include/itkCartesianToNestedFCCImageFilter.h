#ifndef itkCartesianToNestedFCCImageFilter_h
#define itkCartesianToNestedFCCImageFilter_h

#include "detail/itkFCCMirror.h"
#include "detail/itkProduceOutput.h"
#include "detail/itkRowArithmetic.h"
#include "detail/itkRowPasses.h"
#include "itkFCCImage.h"
#include "itkFCCResamplingChecks.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"
#include "itkWorkProgress.h"
#include "rhombicPixelTypes.h"

#include <algorithm>

namespace itk
{

/** \class CartesianToNestedFCCImageFilter
 * \brief Keeps every other sample of a Cartesian volume: the samples on the face-centered cubic lattice nested in its
 * grid.
 *
 * The output has half as many samples as the input, its direction, and its spacing. Lattice coordinates (x, y, z),
 * whose sum is even (see FCCLattice), count the input's samples from its first sample, whatever its start index; so
 * nothing is interpolated, in contrast to CartesianToFCCImageFilter. Beyond the ends the input is continued by its
 * mirror image about the first and last sample. Where its size along x is odd, that makes the last sample of the rows
 * of parity 1.
 *
 * Half the samples carry half the band of frequencies: finer detail would turn into false coarse detail (aliasing).
 * Antialiasing removes it beforehand, with the half-band filter 1/2 + 3/4 A - 1/4 A^3, where A is the mean of a
 * sample's six face neighbours. Its response to a wave is 1 at frequency zero, with vanishing first derivative in A,
 * 1/2 where the two bands meet (A = 0), and 0 at the corner of the spectrum; linear fields pass unchanged. Written out,
 * it is a sum of 45 samples within three steps. Integer outputs are rounded and clamped to the range of their type;
 * arithmetic is in float32. A sample that is not finite spreads as far. Without antialiasing, samples are copied as
 * they are.
 *
 * The filter requests only the part of the input that the requested output needs. Any part of the output has the same
 * bytes whether it is computed alone or with the rest, by one thread or many, on any processor. Extra memory: about 1
 * MiB per thread, more for rows of more than 2500 samples.
 *
 * Throws when the input has no samples or its buffer lacks some that are needed, and when its axes are not
 * perpendicular.
 *
 * Overridden pipeline methods: GenerateOutputInformation() (places the lattice), GenerateInputRequestedRegion() (the
 * half-band filter's reach), GenerateData() (large memory pages for the output; exceptions of all threads are passed
 * on).
 *
 * \ingroup FCCResampling
 */
template <typename TInputImage, typename TOutputImage = FCCImage<typename TInputImage::PixelType>>
class ITK_TEMPLATE_EXPORT CartesianToNestedFCCImageFilter : public ImageToImageFilter<TInputImage, TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(CartesianToNestedFCCImageFilter);

  using Self = CartesianToNestedFCCImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(CartesianToNestedFCCImageFilter, ImageToImageFilter);

  using PixelType = typename TInputImage::PixelType;
  using InputImageRegionType = typename TInputImage::RegionType;
  using OutputImageRegionType = typename TOutputImage::RegionType;

  static_assert(std::is_base_of<FCCImage<PixelType>, TOutputImage>::value,
                "The output must be an FCCImage of the input's pixel type");
  static_assert(TInputImage::ImageDimension == 3, "The face-centered cubic lattice is three-dimensional");

  /** Whether frequencies that the output cannot carry are filtered out before sampling. Default on. */
  itkSetMacro(Antialiasing, bool);
  itkGetConstMacro(Antialiasing, bool);
  itkBooleanMacro(Antialiasing);

protected:
  CartesianToNestedFCCImageFilter() = default;
  ~CartesianToNestedFCCImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "Antialiasing: " << (m_Antialiasing ? "On" : "Off") << std::endl;
  }

  void
  GenerateOutputInformation() override
  {
    const TInputImage * const input = this->GetInput();
    TOutputImage * const output = this->GetOutput();
    const InputImageRegionType region = input->GetLargestPossibleRegion();
    if (region.GetNumberOfPixels() == 0)
    {
      itkExceptionMacro("The input has no samples; its size is " << region.GetSize() << ".");
    }
    if (!AreAxesPerpendicular(input->GetDirection()))
    {
      itkExceptionMacro("The input's axes are not perpendicular to each other, so that every other sample of it is no "
                        "face-centered cubic lattice; resample it with CartesianToFCCImageFilter instead.");
    }
    if (IsFromUnevenSlices(*input))
    {
      itkExceptionMacro("The input's slices are unevenly spaced, so that every other sample of it is no face-centered "
                        "cubic lattice; resample it with CartesianToFCCImageFilter instead.");
    }
    OutputImageRegionType outputRegion;
    outputRegion.SetSize(0, (region.GetSize(0) + 1) / 2);
    outputRegion.SetSize(1, region.GetSize(1));
    outputRegion.SetSize(2, region.GetSize(2));
    output->SetLargestPossibleRegion(outputRegion);
    output->SetSpacing(input->GetSpacing());
    output->SetDirection(input->GetDirection());
    output->SetOrigin(input->template TransformIndexToPhysicalPoint<double>(region.GetIndex()));
    output->SetNumberOfComponentsPerPixel(1);
  }

  void
  GenerateInputRequestedRegion() override
  {
    Superclass::GenerateInputRequestedRegion();
    auto * const input = const_cast<TInputImage *>(this->GetInput());
    const OutputImageRegionType & requested = this->GetOutput()->GetRequestedRegion();
    const IndexValueType reach = m_Antialiasing ? HalfBandReach : 0;
    InputImageRegionType needed = input->GetLargestPossibleRegion();
    if (requested.GetNumberOfPixels() > 0)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const IndexValueType unitsPerIndex = axis == 0 ? 2 : 1;
        const IndexValueType begin = unitsPerIndex * requested.GetIndex(axis) - reach;
        const IndexValueType end = unitsPerIndex * (requested.GetUpperIndex()[axis] + 1) + reach;
        const auto length = static_cast<IndexValueType>(needed.GetSize(axis));
        IndexValueType first = length;
        IndexValueType last = 0;
        for (IndexValueType sample = begin; sample < end; ++sample)
        {
          const IndexValueType source = MirrorIntoRange(sample, 0, length - 1);
          first = std::min(first, source);
          last = std::max(last, source);
        }
        needed.SetIndex(axis, needed.GetIndex(axis) + first);
        needed.SetSize(axis, static_cast<SizeValueType>(last - first + 1));
      }
    }
    input->SetRequestedRegion(needed);
  }

  void
  GenerateData() override
  {
    this->AllocateOutputs();
    ProduceOutput(*this, AllDivided, [this](const OutputImageRegionType & region, WorkProgress::Share & progress) {
      m_Antialiasing ? this->FilterSites(region, progress) : this->CopySites(region, progress);
    });
  }

private:
  /** Start of the input's row (y, z), counted from its first sample. */
  const PixelType *
  GetInputRow(IndexValueType y, IndexValueType z) const
  {
    const TInputImage * const input = this->GetInput();
    auto index = input->GetLargestPossibleRegion().GetIndex();
    index[1] += y;
    index[2] += z;
    return input->GetBufferPointer() + input->ComputeOffset(index);
  }

  void
  CopySites(const OutputImageRegionType & region, WorkProgress::Share & progress)
  {
    TOutputImage * const output = this->GetOutput();
    const auto length = static_cast<IndexValueType>(this->GetInput()->GetLargestPossibleRegion().GetSize(0));

    auto index = region.GetIndex();
    for (index[2] = region.GetIndex(2); index[2] <= region.GetUpperIndex()[2]; ++index[2])
    {
      for (index[1] = region.GetIndex(1); index[1] <= region.GetUpperIndex()[1]; ++index[1])
      {
        const PixelType * const inputRow = this->GetInputRow(index[1], index[2]);
        PixelType * const outputRow = output->GetBufferPointer() + output->ComputeOffset(index);
        const auto count = static_cast<IndexValueType>(region.GetSize(0));
        const IndexValueType first = FCCLattice::SiteOf(index)[0];
        for (IndexValueType i = 0; i < count - 1; ++i)
        {
          outputRow[i] = inputRow[first + 2 * i];
        }
        // Only a row's last site may lie beyond the input.
        outputRow[count - 1] = inputRow[MirrorIntoRange(first + 2 * (count - 1), 0, length - 1)];
        progress.Completed(region.GetSize(0));
      }
    }
  }

  void
  FilterSites(const OutputImageRegionType & region, WorkProgress::Share & progress)
  {
    TOutputImage * const output = this->GetOutput();
    FilterHalfBandRows(
      this->GetInput()->GetLargestPossibleRegion().GetSize(),
      region,
      [&](const Index<3> & start, SizeValueType length, float * row) {
        RowArithmetic::ConvertFrom(this->GetInputRow(start[1], start[2]) + start[0], length, row);
      },
      [&](const Index<3> & start, SizeValueType length, const float * values) {
        RowArithmetic::RoundTo(values, length, output->GetBufferPointer() + output->ComputeOffset(start));
        progress.Completed(length);
      });
  }

  bool m_Antialiasing{ true };
};

// Compiled once, in the library, for the pixel types of scans.
RHOMBIC_INSTANTIATE(extern template class CartesianToNestedFCCImageFilter, rhombic::CartesianImage);

} // namespace itk

#endif
