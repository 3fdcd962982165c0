#ifndef itkFCCIsosurfaceFilter_hxx
#define itkFCCIsosurfaceFilter_hxx

#include "detail/itkForEachSlab.h"
#include "itkFCCRowKernels.h"
#include "itkInputSamples.h"
#include "itkWorkProgress.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace itk
{

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::GenerateData()
{
  m_WorkProgress.emplace(*this, WholeProgress);
  m_UsedFraction = this->ComputeFraction();
  const std::vector<FCCSigns> signs = this->Classify(FCCSurfaceExtractor::GetMargin(m_Mode, m_Closed));
  const std::size_t atOnce = this->IsInMemory() ? 1 : signs.size(); // saves memory, or else passes over the input
  for (std::size_t first = 0; first < signs.size(); first += atOnce)
  {
    this->Extract(signs, first, first + atOnce);
  }
  m_WorkProgress->Finish();
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::Extract(const std::vector<FCCSigns> & signs, std::size_t first, std::size_t last)
{
  RecyclingMemory scratch;
  std::vector<std::unique_ptr<FCCSurfaceExtractor>> extractors;
  for (std::size_t n = first; n < last; ++n)
  {
    extractors.push_back(FCCSurfaceExtractor::Make(m_Mode, signs[n], this->MakeField(m_Isovalues[n], scratch)));
  }
  constexpr SizeValueType around = FCCSurfaceExtractor::PlanesAround;
  const SizeValueType planes = signs.front().GetDepth();
  const float share = 0.95f * static_cast<float>(last - first) / static_cast<float>(signs.size());

  const auto count = [&](SizeValueType begin, SizeValueType end) {
    for (const auto & extractor : extractors)
    {
      m_WorkProgress->CheckAbort();
      extractor->Count(begin, end);
    }
  };
  const bool countReadsSamples = extractors.front()->CountReadsSamples(); // and then there is more to resolve
  const float shareOfCount = countReadsSamples ? 0.35f * share : 0.2f * share;
  const float shareOfResolve = countReadsSamples ? 0.35f * share : 0.0f;
  countReadsSamples ? this->ForEachLoadedSlab(planes, around, shareOfCount, count)
                    : this->ForEachSlab({ 0, planes }, shareOfCount, count, { 1, MostPlanes });

  for (std::size_t n = first; n < last; ++n)
  {
    FCCSurfaceExtractor & extractor = *extractors[n - first];
    this->Resolve(extractor, shareOfResolve / static_cast<float>(last - first));
    this->Allocate(*this->GetOutput(n), extractor.GetNumberOfPoints(), extractor.GetMostTriangles());
  }
  scratch.ReleaseSpare(); // filling needs blocks of other sizes
  this->ForEachLoadedSlab(
    planes, around, share - shareOfCount - shareOfResolve, [&](SizeValueType begin, SizeValueType end) {
      for (std::size_t n = first; n < last; ++n)
      {
        extractors[n - first]->Fill(begin, end, *this->GetOutput(n));
      }
    });
  for (std::size_t n = first; n < last; ++n)
  {
    TriangleSurface & surface = *this->GetOutput(n);
    extractors[n - first]->Finish(surface);
    if (!m_Closed)
    {
      surface.RemoveUnusedPoints(); // on edges of no cell, at the ragged ends of rows
    }
    surface.Modified();
  }
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::Resolve(FCCSurfaceExtractor & extractor, float share)
{
  const SizeValueType last = m_WorkProgress->GetCompleted() + AmountOf(share);
  FCCSurfaceExtractor::Workers workers;
  workers.forEach = [this, share](SizeValueType count, float part, const std::function<void(SizeValueType)> & work) {
    const auto forEach = [&work](SizeValueType begin, SizeValueType end) {
      for (SizeValueType n = begin; n < end; ++n)
      {
        work(n);
      }
    };
    this->ForEachSlab({ 0, count }, part * share, forEach, { 1, 1 });
  };
  workers.checkAbort = [this] { m_WorkProgress->CheckAbort(); };
  extractor.Resolve(workers);
  m_WorkProgress->Completed(last - std::min(last, m_WorkProgress->GetCompleted())); // the work was estimated
}

template <typename TInputImage>
double
FCCIsosurfaceFilter<TInputImage>::ComputeFraction() const
{
  const InputImageType * const image = this->GetInput();
  const auto & region = this->GetRegion();
  double farthest = 0.0; // coordinate of the extent's corners
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    std::array<double, 3> coordinates{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double index =
        static_cast<double>((corner >> axis & 1) != 0 ? region.GetUpperIndex()[axis] + 1 : region.GetIndex(axis) - 1);
      coordinates[axis] = axis == 0 ? 2.0 * index : index;
    }
    const auto point = image->template TransformLatticeToPhysicalPoint<double>(coordinates);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      farthest = std::max(farthest, std::abs(point[axis]));
    }
  }
  const auto & spacing = image->GetSpacing();
  const double shortestEdge = std::sqrt(2.0) * std::min({ spacing[0], spacing[1], spacing[2] });
  constexpr double steps = 8.0; // float32 steps between two points, so that rounding keeps them apart
  const double resolution = farthest * static_cast<double>(std::numeric_limits<float>::epsilon());
  const double fraction = std::max(MinimumFraction, steps * resolution / shortestEdge);
  if (!(fraction <= 0.25))
  {
    itkExceptionMacro("The image's edges of " << shortestEdge
                                              << " mm are too short to be told apart in 32-bit positions " << farthest
                                              << " mm from the origin; move the origin nearer.");
  }
  return fraction;
}

template <typename TInputImage>
auto
FCCIsosurfaceFilter<TInputImage>::FindDivision(SizeValueType planes, SizeValueType k) const -> Planes
{
  const SizeValueType depth = std::max<SizeValueType>(1, this->GetRegion().GetSize(2));
  const auto divisions = std::min<SizeValueType>(m_NumberOfStreamDivisions, depth);
  const SizeValueType n = ((k + 1) * divisions - 1) / std::max<SizeValueType>(1, planes);
  return { n * planes / divisions, (n + 1) * planes / divisions };
}

template <typename TInputImage>
ImageRegion<3>
FCCIsosurfaceFilter<TInputImage>::RegionOf(const Planes & division, SizeValueType planes, SizeValueType around) const
{
  ImageRegion<3> region = this->GetRegion();
  const SizeValueType depth = region.GetSize(2);
  const SizeValueType margin = (planes - depth) / 2; // planes of signs beyond the image on either side
  const SizeValueType before = margin + around;
  const SizeValueType begin = division.begin - std::min(before, division.begin);
  const SizeValueType end = std::min(division.end + around - std::min(margin, division.end + around), depth);
  region.SetIndex(2, region.GetIndex(2) + static_cast<IndexValueType>(begin));
  region.SetSize(2, end - begin);
  return region;
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::Load(const ImageRegion<3> & region)
{
  auto * const image = const_cast<InputImageType *>(this->GetInput());
  if (!image->GetBufferedRegion().IsInside(region) && image->GetSource() != nullptr)
  {
    if (m_ReleasesInput)
    {
      image->ReleaseData();
    }
    image->SetRequestedRegion(region);
    const AbortForwarding forwarding(*this, *image);
    try
    {
      image->PropagateRequestedRegion();
      image->UpdateOutputData();
      m_WorkProgress->CheckAbort(); // some filters upstream, as StreamingImageFilter, end without an exception
    }
    catch (...)
    {
      image->ReleaseData(); // so that the next update does not take the unfinished data for finished ones
      throw;
    }
  }
  VerifyInputSamples(*this, *image, region);
}

template <typename TInputImage>
template <typename TWork>
void
FCCIsosurfaceFilter<TInputImage>::ForEachLoadedSlab(SizeValueType planes,
                                                    SizeValueType around,
                                                    float share,
                                                    const TWork & work)
{
  for (SizeValueType begin = 0; begin < planes;)
  {
    const Planes division = this->FindDivision(planes, begin);
    m_WorkProgress->CheckAbort();
    this->Load(this->RegionOf(division, planes, around));
    const SizeValueType count = division.end - begin;
    const SizeValueType least = around > 0 && !this->IsInMemory() ? LeastPlanesOfSlab : 1;
    this->ForEachSlab(
      division, share * static_cast<float>(count) / static_cast<float>(planes), work, { least, MostPlanes });
    begin = division.end;
  }
}

template <typename TInputImage>
template <typename TWork>
void
FCCIsosurfaceFilter<TInputImage>::ForEachSlab(const Planes & planes,
                                              float share,
                                              const TWork & work,
                                              const PlanesInOneGo & inOneGo)
{
  const SizeValueType count = planes.end - planes.begin;
  const SizeValueType amount = AmountOf(share);
  itk::ForEachSlab(*this, count, inOneGo.least, inOneGo.most, [&](SizeValueType begin, SizeValueType end) {
    m_WorkProgress->CheckAbort();
    work(planes.begin + begin, planes.begin + end);
    m_WorkProgress->Completed(amount * end / count - amount * begin / count);
  });
}

template <typename TInputImage>
std::vector<FCCSigns>
FCCIsosurfaceFilter<TInputImage>::Classify(SizeValueType margin)
{
  const InputImageType * const image = this->GetInput();
  const auto & region = this->GetRegion();
  const auto shift = static_cast<IndexValueType>(margin);
  std::vector<FCCSigns> signs;
  signs.reserve(m_Isovalues.size());
  while (signs.size() < m_Isovalues.size())
  {
    signs.emplace_back(region.GetSize(0) + 2 * margin,
                       region.GetSize(1) + 2 * margin,
                       region.GetSize(2) + 2 * margin,
                       FCCLattice::Parity(region.GetIndex(1) - shift, region.GetIndex(2) - shift));
  }
  std::atomic<SizeValueType> undefined{ 0 };
  this->ForEachLoadedSlab(region.GetSize(2), 0, 0.05f, [&](SizeValueType begin, SizeValueType end) {
    SizeValueType undefinedInSlab = 0;
    for (SizeValueType k = begin; k < end; ++k)
    {
      m_WorkProgress->CheckAbort();
      for (SizeValueType j = 0; j < region.GetSize(1); ++j)
      {
        const PixelType * const values = GetRow(*image, j, k);
        if constexpr (std::is_floating_point_v<PixelType>)
        {
          for (SizeValueType i = 0; i < region.GetSize(0); ++i)
          {
            undefinedInSlab += values[i] != values[i] ? 1 : 0;
          }
        }
        for (std::size_t n = 0; n < signs.size(); ++n)
        {
          FCCSigns::WordType * const row = signs[n].GetRow(j + margin, k + margin);
          FCCRowKernels::Classify(values, region.GetSize(0), m_Isovalues[n], m_InsideIsBelow, row);
          if (margin > 0)
          {
            FCCBits::MoveUp(row, signs[n].GetNumberOfWords());
          }
        }
      }
    }
    undefined += undefinedInSlab;
  });
  m_NumberOfUndefinedSamples = undefined;
  return signs;
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::Allocate(TriangleSurface & surface,
                                           SizeValueType points,
                                           SizeValueType triangles) const
{
  if (points > std::numeric_limits<std::uint32_t>::max())
  {
    itkExceptionMacro("The surface would have "
                      << points
                      << " points, more than 32-bit indices reach; resample at a lower density, or "
                         "extract from a smaller region.");
  }
  surface.Initialize();
  surface.GetPoints().resize(points);
  surface.GetNormals().resize(m_ComputeNormals ? points : 0);
  surface.GetTriangles().resize(triangles);
}

template <typename TInputImage>
FCCScalarField
FCCIsosurfaceFilter<TInputImage>::MakeField(double isovalue, RecyclingMemory & scratch) const
{
  const InputImageType * const image = this->GetInput();
  const SizeValueType width = this->GetRegion().GetSize(0);
  const auto readRow = [this, image, width, isovalue](SizeValueType j, SizeValueType k, float * values) {
    m_WorkProgress->CheckAbort(); // slabs take long
    FCCRowKernels::Subtract(GetRow(*image, j, k), width, isovalue, values);
  };
  return { this->GetRegion(), this->MakeFrame(), m_InsideIsBelow, m_Closed, m_UsedFraction, readRow, &scratch };
}

template <typename TInputImage>
FCCFrame
FCCIsosurfaceFilter<TInputImage>::MakeFrame() const
{
  const InputImageType * const image = this->GetInput();
  FCCFrame frame;
  frame.outwardSign = m_InsideIsBelow ? 1.0 : -1.0;
  const auto & direction = image->GetDirection();
  const auto & inverse = image->GetInverseDirection();
  for (unsigned int row = 0; row < 3; ++row)
  {
    frame.origin[row] = image->GetOrigin()[row];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      frame.matrix[row][axis] = direction[row][axis] * image->GetSpacing()[axis];
      frame.gradientToWorld[row][axis] = inverse[axis][row] / image->GetSpacing()[axis];
    }
  }
  return frame;
}

} // namespace itk

#endif
