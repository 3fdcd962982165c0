#ifndef itkCartesianToFCCImageFilter_h
#define itkCartesianToFCCImageFilter_h

#include "detail/itkCartesianToFCCRows.h"
#include "detail/itkProduceOutput.h"
#include "detail/itkRowArithmetic.h"
#include "itkFCCImage.h"
#include "itkFCCResamplingChecks.h"
#include "itkImage.h"
#include "itkImageToImageFilter.h"
#include "itkSeparableTaps.h"
#include "itkSlicePlacement.h"
#include "itkWorkProgress.h"
#include "rhombicPixelTypes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace itk
{

/** \class CartesianToFCCImageFilter
 * \brief Resamples a Cartesian volume onto the face-centered cubic lattice.
 *
 * By default the lattice has FCCLattice::DefaultDensity (0.7698) times as many samples per volume as the input, which
 * carries the same band of frequencies in all directions, and the aspect of the input's voxels. Other densities are set
 * by SetDensity(), or the lattice's spacing itself by SetOutputSpacing().
 *
 * The output has the input's direction, unless that is sheared (see below). Its extent (see FCCImage) covers the
 * input's, from the outer face of the first voxel to that of the last, and is centred on it; as long as the lattice's
 * spacing is not larger than the voxels, every input sample lies between output samples. The output's indices start at
 * (0, 0, 0), whatever the input's start index. Where output samples lie beyond the outermost input samples, the field
 * is constant along the axis. There is no low-pass filter: at densities far below the default, smooth the input first.
 *
 * Values between samples come from a separable kernel (see SeparableTaps), the cubic B-spline with its prefilter by
 * default, because linear interpolation blurs away the gain of the lattice. B-splines overshoot at edges; integer
 * outputs are rounded and clamped to the range of their type. Arithmetic is in float32, which is exact for 16-bit
 * pixels and good for 7 digits of wider ones. An input sample that is not finite makes all outputs within the kernel's
 * reach, up to 5 samples along each axis, not a number: replace such samples before.
 *
 * The kernel is applied along y, z, and x in turn. A lattice row lies at constant y and z, so that each of these is a
 * pass over whole rows. The input is converted to float32 a row at a time, in blocks whose intermediate results fit a
 * processor's cache. Extra memory: 1 MiB per thread, or ten input rows for each of eight output rows if that is more.
 * The filter requests only the part of the input that the requested output needs (but see SetOutsideValue()). Any part
 * of the output has the same bytes whether it is computed alone or with the rest, by one thread or many, on any
 * processor.
 *
 * **Slanted inputs.** Where the input's axes are not perpendicular (a tilted gantry, a sheared affine), or its slices
 * are unevenly placed (as an image from ScanFileReader knows, or SetScan() says), samples are used at their true
 * positions, and not resampled to an even grid first. The lattice then has perpendicular axes: x along the input's
 * first axis, y in the plane of its slices, z along their normal, towards the last slice. Its extent covers the box,
 * along these axes, around the outer faces of all voxels, and is centred on it; density and aspect refer to the
 * distances between samples of a row, between rows, and between slices (the median). Output samples that are more than
 * half a sample beside the slices get OutsideValue; above and below the stack, the field is constant along the line
 * through its last two slices' origins.
 *
 * The kernels work in units of samples, as above. A tilt or shear costs no accuracy: with Linear and CubicBSpline,
 * linear fields of the world are exact, and smooth ones as good as from perpendicular axes. Along unevenly placed
 * slices, CubicBSpline and Lanczos4 are a spline through the slices' true positions instead (see SeparableTaps), which
 * the origins follow, too; linear fields are exact there, whatever the steps and shifts. How good other fields are
 * depends on the longest step, and where slices are shifted against each other irregularly, on how little the field
 * changes over a shift.
 *
 * The kernel is then applied along z, y, and x in turn, with weights made for each plane of the lattice: 1.5 times the
 * time for a volume, and where the in-plane axes are not perpendicular, with weights for each row: 16 times. Extra
 * memory: 22 input rows per thread.
 *
 * Throws when the input has no samples or its buffer lacks some that are needed, when a parameter is out of range, when
 * the lattice would have more than 2^40 samples, when the slice origins are not as many as the slices or not in order
 * along their normal, and when the places of unevenly spaced slices are not known (see SetScan()).
 *
 * Overridden pipeline methods: VerifyPreconditions() (parameters in range), GenerateOutputInformation() (places the
 * lattice; refuses slice origins that are not in order), GenerateInputRequestedRegion() (the kernel's reach),
 * GenerateData() (large memory pages for the output; exceptions of all threads are passed on).
 *
 * \ingroup FCCResampling
 */
template <typename TInputImage, typename TOutputImage = FCCImage<typename TInputImage::PixelType>>
class ITK_TEMPLATE_EXPORT CartesianToFCCImageFilter
  : public ImageToImageFilter<TInputImage, TOutputImage>
  , public SlicePlacingFilter
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(CartesianToFCCImageFilter);

  using Self = CartesianToFCCImageFilter;
  using Superclass = ImageToImageFilter<TInputImage, TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(CartesianToFCCImageFilter, ImageToImageFilter);

  using InputPixelType = typename TInputImage::PixelType;
  using OutputPixelType = typename TOutputImage::PixelType;
  using InputImageRegionType = typename TInputImage::RegionType;
  using OutputImageRegionType = typename TOutputImage::RegionType;
  using SpacingType = typename TOutputImage::SpacingType;

  static_assert(std::is_base_of<FCCImage<OutputPixelType>, TOutputImage>::value, "The output must be an FCCImage");
  static_assert(TInputImage::ImageDimension == 3, "The face-centered cubic lattice is three-dimensional");

  /** Output samples per input sample, for the same volume. Default FCCLattice::DefaultDensity. Must be positive. */
  itkSetMacro(Density, double);
  itkGetConstMacro(Density, double);

  /** Spacing of the output in mm, the unit of its lattice coordinates (see FCCImage). Default all 0: the spacing
   * follows from the density and the input's spacing. */
  itkSetMacro(OutputSpacing, SpacingType);
  itkGetConstReferenceMacro(OutputSpacing, SpacingType);

  /** The kernel of interpolation. Default SeparableKernel::CubicBSpline. */
  itkSetEnumMacro(Kernel, SeparableKernel);
  itkGetEnumMacro(Kernel, SeparableKernel);

  using SliceOriginsType = std::vector<typename TInputImage::PointType>;

  /** The scan that the input is made from, by any filters that keep its slices: those of an unevenly spaced scan lie
   * where they were scanned (see FindSliceOrigins()), which ITK's filters do not pass on. Default none: an image from
   * ScanFileReader knows itself, and an image that was made from one with unevenly spaced slices is refused.
   *
   * \tparam TScan rhombic::Scan, as `reader->GetScan()`; its PlacementOf() throws when the scan was not read */
  template <typename TScan>
  void
  SetScan(const TScan & scan)
  {
    m_Scan = PlacementOf(scan);
    this->Modified();
  }

  /** Positions in LPS mm of the first sample of each slice along the input's third axis, for stacks of another source
   * whose slices are unevenly spaced or shifted against each other: one for each slice, in order along the slices'
   * normal. Default empty: those of the scan, or else they follow from the input's origin, spacing and direction. */
  void
  SetSliceOrigins(const SliceOriginsType & sliceOrigins)
  {
    if (m_SliceOrigins != sliceOrigins)
    {
      m_SliceOrigins = sliceOrigins;
      this->Modified();
    }
  }
  itkGetConstReferenceMacro(SliceOrigins, SliceOriginsType);

  /** Value of output samples beside a slanted input. Default none: the lowest value of the input, for which the filter
   * requests the whole of a slanted input. NaN is not a lowest value. */
  void
  SetOutsideValue(const std::optional<OutputPixelType> & outsideValue)
  {
    if (m_OutsideValue != outsideValue)
    {
      m_OutsideValue = outsideValue;
      this->Modified();
    }
  }
  itkGetConstReferenceMacro(OutsideValue, std::optional<OutputPixelType>);

protected:
  CartesianToFCCImageFilter() = default;
  ~CartesianToFCCImageFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "Density: " << m_Density << std::endl;
    os << indent << "OutputSpacing: " << m_OutputSpacing << std::endl;
    os << indent << "Kernel: " << m_Kernel << std::endl;
    os << indent << "SliceOrigins: ";
    PrintSliceOrigins(os, m_SliceOrigins);
    os << std::endl << indent << "SliceOrigins of the scan: ";
    PrintSliceOrigins(os, m_Scan.origins);
    os << std::endl << indent << "OutsideValue: ";
    if (m_OutsideValue)
    {
      os << static_cast<typename NumericTraits<OutputPixelType>::PrintType>(*m_OutsideValue) << std::endl;
    }
    else
    {
      os << "(lowest of the input)" << std::endl;
    }
  }

  void
  VerifyPreconditions() ITKv5_CONST override
  {
    Superclass::VerifyPreconditions();
    if (!(m_Density > 0.0) || !std::isfinite(m_Density))
    {
      itkExceptionMacro("Density must be a positive number of output samples per input sample, not "
                        << m_Density << "; the default is " << FCCLattice::DefaultDensity << ".");
    }
    if (m_Kernel > SeparableKernel::Lanczos4)
    {
      itkExceptionMacro("There is no Kernel number " << static_cast<int>(m_Kernel)
                                                     << "; use Linear, CubicBSpline or Lanczos4.");
    }
    if (!IsFCCSpacingOrUnset(m_OutputSpacing))
    {
      itkExceptionMacro("OutputSpacing must be positive along each axis, not "
                        << m_OutputSpacing << "; set it to zero along all of them to derive it from Density.");
    }
  }

  void
  GenerateOutputInformation() override
  {
    const TInputImage * const input = this->GetInput();
    TOutputImage * const output = this->GetOutput();
    const auto & region = input->GetLargestPossibleRegion();
    if (region.GetNumberOfPixels() == 0)
    {
      itkExceptionMacro("The input has no samples; its size is " << region.GetSize() << ".");
    }

    std::optional<SliceStack> stack;
    SpacingType inputSpacing = input->GetSpacing();
    SpacingType lengths;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      lengths[axis] = static_cast<double>(region.GetSize(axis));
    }
    if (this->IsSlanted())
    {
      stack.emplace(*input, this->FindSliceOrigins());
      inputSpacing = stack->GetPitch();
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        lengths[axis] = (stack->GetHighest()[axis] - stack->GetLowest()[axis]) / inputSpacing[axis];
      }
    }

    const double scale = std::cbrt(1.0 / (FCCLattice::CellVolume * m_Density));
    std::array<double, 3> counts{};
    SpacingType spacing;
    SpacingType first; // from the middle of the input's first sample to the lattice point (0, 0, 0), in samples
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      constexpr double tolerance = 1e-9; // relative to a sample, against rounding
      spacing[axis] = m_OutputSpacing[axis] > 0.0 ? m_OutputSpacing[axis] : scale * inputSpacing[axis];
      const double step = spacing[axis] / inputSpacing[axis];
      const double units = lengths[axis] / step;
      // Along x a row's samples are two units apart and the rows of the other parity are shifted by one, so that
      // covering the input with both takes one unit more.
      const double samples = axis == 0 ? (units + 1.0) / 2.0 : units;
      counts[axis] = std::max(1.0, std::ceil(samples - tolerance));
      const double span = axis == 0 ? 2.0 * counts[axis] - 1.0 : counts[axis] - 1.0;
      first[axis] = (lengths[axis] - 1.0 - span * step) / 2.0;
    }
    if (!IsFCCSizeCountable(counts))
    {
      itkExceptionMacro("The lattice would have " << counts[0] << " x " << counts[1] << " x " << counts[2]
                                                  << " samples; use a larger OutputSpacing or a smaller Density.");
    }
    OutputImageRegionType outputRegion;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      outputRegion.SetSize(axis, static_cast<SizeValueType>(counts[axis]));
    }
    output->SetLargestPossibleRegion(outputRegion);
    output->SetSpacing(spacing);
    if (stack)
    {
      output->SetDirection(stack->GetDirection());
      SpacingType frame = stack->GetLowest();
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        frame[axis] += (0.5 + first[axis]) * inputSpacing[axis];
      }
      output->SetOrigin(stack->TransformFrameToPoint(frame));
    }
    else
    {
      output->SetDirection(input->GetDirection());
      ContinuousIndex<double, 3> index;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        index[axis] = static_cast<double>(region.GetIndex(axis)) + first[axis];
      }
      output->SetOrigin(input->template TransformContinuousIndexToPhysicalPoint<double>(index));
    }
    output->SetNumberOfComponentsPerPixel(1);
  }

  void
  GenerateInputRequestedRegion() override
  {
    Superclass::GenerateInputRequestedRegion();
    auto * const input = const_cast<TInputImage *>(this->GetInput());
    const OutputImageRegionType & requested = this->GetOutput()->GetRequestedRegion();
    InputImageRegionType needed = input->GetLargestPossibleRegion();
    if (requested.GetNumberOfPixels() > 0 && (m_OutsideValue || !this->IsSlanted()))
    {
      needed = this->MakeRows().FindNeededSamples(requested);
    }
    input->SetRequestedRegion(needed);
  }

  void
  GenerateData() override
  {
    this->AllocateOutputs();
    const OutputPixelType outsideValue = this->IsSlanted() ? this->FindOutsideValue() : OutputPixelType{};
    ProduceOutput(*this, AllDivided, [=](const OutputImageRegionType & region, WorkProgress::Share & progress) {
      this->Resample(region, outsideValue, progress);
    });
  }

private:
  /** The positions that were set, or else those of the scan; empty where they follow from the input's geometry. */
  SliceOriginsType
  FindSliceOrigins() const
  {
    return m_SliceOrigins.empty() ? itk::FindSliceOrigins(*this->GetInput(), m_Scan) : m_SliceOrigins;
  }

  /** Whether the samples are those of a SliceStack rather than of perpendicular axes. */
  bool
  IsSlanted() const
  {
    return !this->FindSliceOrigins().empty() || !AreAxesPerpendicular(this->GetInput()->GetDirection());
  }

  /** The value that was set, or else the lowest of the input. */
  OutputPixelType
  FindOutsideValue()
  {
    if (m_OutsideValue)
    {
      return *m_OutsideValue;
    }
    const TInputImage & input = *this->GetInput();
    if (m_LowestValueTime != input.GetMTime())
    {
      VerifyInputSamples(*this, input, input.GetLargestPossibleRegion());
      const InputPixelType * const begin = input.GetBufferPointer();
      const InputPixelType * const end = begin + input.GetBufferedRegion().GetNumberOfPixels();
      auto lowest = std::numeric_limits<InputPixelType>::max();
      std::for_each(begin, end, [&lowest](InputPixelType value) { lowest = value < lowest ? value : lowest; });
      m_LowestValue = RoundAndClamp<OutputPixelType>(static_cast<double>(lowest));
      m_LowestValueTime = input.GetMTime();
    }
    return m_LowestValue;
  }

  void
  Resample(const OutputImageRegionType & region, OutputPixelType outsideValue, WorkProgress::Share & progress)
  {
    const TInputImage * const input = this->GetInput();
    TOutputImage * const output = this->GetOutput();
    const auto load = [&](const Index<3> & start, SizeValueType length, float * row) {
      const auto * const samples = input->GetBufferPointer() + input->ComputeOffset(start);
      RowArithmetic::ConvertFrom(samples, length, row);
    };
    const auto store = [&](const Index<3> & start, SizeValueType length, const float * values) {
      const Index<3> rowStart{ { region.GetIndex(0), start[1], start[2] } };
      OutputPixelType * const row = output->GetBufferPointer() + output->ComputeOffset(rowStart);
      OutputPixelType * const begin = row + (start[0] - rowStart[0]);
      std::fill(row, begin, outsideValue);
      RowArithmetic::RoundTo(values, length, begin);
      std::fill(begin + length, row + region.GetSize(0), outsideValue);
      progress.Completed(region.GetSize(0));
    };

    this->MakeRows().Resample(region, load, store);
  }

  /** The kernel, from the input's geometry to the output's. */
  CartesianToFCCRows
  MakeRows() const
  {
    return { *this->GetInput(), *this->GetOutput(), m_Kernel, this->FindSliceOrigins() };
  }

  double m_Density{ FCCLattice::DefaultDensity };
  SpacingType m_OutputSpacing{ 0.0 };
  SlicePlacement m_Scan;
  SliceOriginsType m_SliceOrigins;
  std::optional<OutputPixelType> m_OutsideValue;
  OutputPixelType m_LowestValue{};         // of the input
  ModifiedTimeType m_LowestValueTime{ 0 }; // of the input, when m_LowestValue was found
  SeparableKernel m_Kernel{ SeparableKernel::CubicBSpline };
};

// Compiled once, in the library, for the pixel types of scans.
RHOMBIC_INSTANTIATE(extern template class CartesianToFCCImageFilter, rhombic::CartesianImage);

} // namespace itk

#endif
