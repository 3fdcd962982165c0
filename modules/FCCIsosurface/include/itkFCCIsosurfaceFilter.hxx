#ifndef itkFCCIsosurfaceFilter_hxx
#define itkFCCIsosurfaceFilter_hxx

#include "itkFCCEdgePoints.h"
#include "itkFCCLeanSurface.h"
#include "itkMultiThreaderBase.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace itk
{

template <typename TInputImage>
FCCIsosurfaceFilter<TInputImage>::FCCIsosurfaceFilter()
{
  this->SetNumberOfRequiredInputs(1);
  this->SetNumberOfRequiredOutputs(1);
  this->ProcessObject::SetNthOutput(0, this->MakeOutput(0));
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::SetInput(const InputImageType * image)
{
  this->ProcessObject::SetNthInput(0, const_cast<InputImageType *>(image));
}

template <typename TInputImage>
auto
FCCIsosurfaceFilter<TInputImage>::GetInput() const -> const InputImageType *
{
  return itkDynamicCastInDebugMode<const InputImageType *>(this->GetPrimaryInput());
}

template <typename TInputImage>
TriangleSurface *
FCCIsosurfaceFilter<TInputImage>::GetOutput(DataObjectPointerArraySizeType n)
{
  return itkDynamicCastInDebugMode<TriangleSurface *>(this->ProcessObject::GetOutput(n));
}

template <typename TInputImage>
const TriangleSurface *
FCCIsosurfaceFilter<TInputImage>::GetOutput(DataObjectPointerArraySizeType n) const
{
  return itkDynamicCastInDebugMode<const TriangleSurface *>(this->ProcessObject::GetOutput(n));
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::SetIsovalues(const std::vector<double> & isovalues)
{
  if (isovalues == m_Isovalues)
  {
    return;
  }
  if (isovalues.empty())
  {
    itkExceptionMacro("There must be at least one isovalue.");
  }
  m_Isovalues = isovalues;
  this->SetNumberOfIndexedOutputs(isovalues.size());
  for (std::size_t n = 0; n < isovalues.size(); ++n)
  {
    if (this->ProcessObject::GetOutput(n) == nullptr)
    {
      this->ProcessObject::SetNthOutput(n, this->MakeOutput(n));
    }
  }
  this->Modified();
}

template <typename TInputImage>
DataObject::Pointer
FCCIsosurfaceFilter<TInputImage>::MakeOutput(DataObjectPointerArraySizeType)
{
  return TriangleSurface::New().GetPointer();
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Isovalues:";
  for (const double isovalue : m_Isovalues)
  {
    os << ' ' << isovalue;
  }
  os << std::endl;
  os << indent << "Mode: " << m_Mode << std::endl;
  os << indent << "ComputeNormals: " << (m_ComputeNormals ? "On" : "Off") << std::endl;
  os << indent << "NumberOfUndefinedSamples: " << m_NumberOfUndefinedSamples << std::endl;
  os << indent << "InsideIsBelow: " << (m_InsideIsBelow ? "On" : "Off") << std::endl;
  os << indent << "Closed: " << (m_Closed ? "On" : "Off") << std::endl;
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  for (const double isovalue : m_Isovalues)
  {
    if (!std::isfinite(isovalue))
    {
      itkExceptionMacro("Isovalue must be a finite number, not " << isovalue << ".");
    }
  }
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::GenerateData()
{
  this->UpdateProgress(0.0f);
  m_UsedFraction = this->ComputeFraction();
  const bool isLean = m_Mode == FCCIsosurfaceMode::Lean;
  const std::vector<FCCSigns> signs = this->Classify(m_Closed || isLean ? 1 : 0);
  for (std::size_t n = 0; n < m_Isovalues.size(); ++n)
  {
    TriangleSurface & surface = *this->GetOutput(n);
    surface.Initialize();
    switch (m_Mode)
    {
      case FCCIsosurfaceMode::Lean:
        this->ExtractLean(signs[n], m_Isovalues[n], surface);
        break;
      case FCCIsosurfaceMode::Octahedra:
        this->ExtractCells(signs[n], m_Isovalues[n], FCCCellScheme::Octahedra, surface);
        break;
      case FCCIsosurfaceMode::Parallelepipeds:
        this->ExtractCells(signs[n], m_Isovalues[n], FCCCellScheme::Parallelepipeds, surface);
        break;
      case FCCIsosurfaceMode::Tetrahedra:
      case FCCIsosurfaceMode::Fine:
        this->ExtractTetrahedra(signs[n], m_Isovalues[n], surface);
    }
    if (!m_Closed)
    {
      surface.RemoveUnusedPoints(); // on edges of no cell, at the ragged ends of rows
    }
    surface.Modified();
  }
  this->UpdateProgress(1.0f);
}

template <typename TInputImage>
double
FCCIsosurfaceFilter<TInputImage>::ComputeFraction() const
{
  const InputImageType * const image = this->GetInput();
  const auto & region = image->GetBufferedRegion();
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
  constexpr double steps = 8.0; // of float32 between two points, so that rounding can't bring them together
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
template <typename TWork>
void
FCCIsosurfaceFilter<TInputImage>::ForEachSlab(SizeValueType planes,
                                              float share,
                                              const TWork & work,
                                              SizeValueType mostPlanes)
{
  const SizeValueType units = std::max<SizeValueType>(1, this->GetNumberOfWorkUnits());
  const SizeValueType planesPerSlab = std::clamp<SizeValueType>(planes / (4 * units), 1, mostPlanes);
  const SizeValueType slabs = (planes + planesPerSlab - 1) / planesPerSlab;
  ThreadFailure failure;
  MultiThreaderBase * const threader = this->GetMultiThreader();
  threader->SetNumberOfWorkUnits(this->GetNumberOfWorkUnits());
  threader->ParallelizeArray(
    0,
    slabs,
    [&](SizeValueType slab) {
      failure.Capture([&] {
        if (this->GetAbortGenerateData())
        {
          throw ProcessAborted(__FILE__, __LINE__);
        }
        const SizeValueType begin = slab * planesPerSlab;
        work(begin, std::min(begin + planesPerSlab, planes));
        this->IncrementProgress(share / static_cast<float>(slabs));
      });
    },
    nullptr);
  failure.Rethrow();
}

template <typename TInputImage>
std::vector<FCCSigns>
FCCIsosurfaceFilter<TInputImage>::Classify(SizeValueType margin)
{
  const InputImageType * const image = this->GetInput();
  const auto & region = image->GetBufferedRegion();
  const auto shift = static_cast<IndexValueType>(margin);
  const FCCSigns blank(region.GetSize(0) + 2 * margin,
                       region.GetSize(1) + 2 * margin,
                       region.GetSize(2) + 2 * margin,
                       FCCLattice::Parity(region.GetIndex(1) - shift, region.GetIndex(2) - shift));
  std::vector<FCCSigns> signs(m_Isovalues.size(), blank);
  std::atomic<SizeValueType> undefined{ 0 };
  this->ForEachSlab(region.GetSize(2), 0.1f, [&](SizeValueType begin, SizeValueType end) {
    SizeValueType undefinedInSlab = 0;
    for (SizeValueType k = begin; k < end; ++k)
    {
      for (SizeValueType j = 0; j < region.GetSize(1); ++j)
      {
        const PixelType * const values = image->GetBufferPointer() + (k * region.GetSize(1) + j) * region.GetSize(0);
        if constexpr (std::is_floating_point_v<PixelType>)
        {
          for (SizeValueType i = 0; i < region.GetSize(0); ++i)
          {
            undefinedInSlab += values[i] != values[i] ? 1 : 0;
          }
        }
        for (std::size_t n = 0; n < signs.size(); ++n)
        {
          FCCRowKernels::Classify(
            values, region.GetSize(0), m_Isovalues[n], m_InsideIsBelow, signs[n].GetRow(j + margin, k + margin));
          if (margin > 0)
          {
            signs[n].ShiftRow(j + margin, k + margin);
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
  surface.GetPoints().resize(points);
  surface.GetNormals().resize(m_ComputeNormals ? points : 0);
  surface.GetTriangles().resize(triangles);
}

template <typename TInputImage>
FCCFieldPlanes::RowReader
FCCIsosurfaceFilter<TInputImage>::MakeRowReader(double isovalue) const
{
  const InputImageType * const image = this->GetInput();
  const auto & size = image->GetBufferedRegion().GetSize();
  return [image, size, isovalue](SizeValueType j, SizeValueType k, float * values) {
    FCCRowKernels::Subtract(image->GetBufferPointer() + (k * size[1] + j) * size[0], size[0], isovalue, values);
  };
}

template <typename TInputImage>
FCCEdgePoints
FCCIsosurfaceFilter<TInputImage>::MakeEdgePoints() const
{
  const bool isCubic = m_Mode == FCCIsosurfaceMode::Fine;
  return FCCEdgePoints(
    this->GetInput()->GetBufferedRegion(), this->MakeFrame(), isCubic, m_UsedFraction, m_Closed ? 1 : 0);
}

template <typename TInputImage>
FCCEdgePointFiller
FCCIsosurfaceFilter<TInputImage>::MakeFiller(const FCCSigns & signs,
                                             double isovalue,
                                             const FCCEdgePoints & edgePoints) const
{
  return FCCEdgePointFiller(
    signs, this->GetInput()->GetBufferedRegion(), m_Closed ? 1 : 0, edgePoints, this->MakeRowReader(isovalue));
}

template <typename TInputImage>
bool
FCCIsosurfaceFilter<TInputImage>::IsLeftHanded() const
{
  return vnl_determinant(this->GetInput()->GetDirection().GetVnlMatrix()) < 0.0;
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::ExtractLean(const FCCSigns & signs, double isovalue, TriangleSurface & surface)
{
  const InputImageType * const image = this->GetInput();
  const auto & size = image->GetBufferedRegion().GetSize();
  FCCLeanSurface lean(signs,
                      image->GetBufferedRegion(),
                      this->MakeFrame(),
                      m_InsideIsBelow,
                      m_UsedFraction,
                      this->MakeRowReader(isovalue));
  const float share = 0.9f / static_cast<float>(m_Isovalues.size());
  const SizeValueType planes = signs.GetDepth();
  this->ForEachSlab(planes, 0.5f * share, [&](SizeValueType begin, SizeValueType end) { lean.Count(begin, end); });
  lean.Resolve(
    [&](const std::array<SizeValueType, 3> * sites, unsigned int wanted, float * values) {
      for (; wanted != 0; wanted &= wanted - 1)
      {
        const auto n = static_cast<unsigned int>(__builtin_ctz(wanted));
        const auto [i, j, k] = sites[n];
        const auto pixel = image->GetBufferPointer()[((k - 1) * size[1] + j - 1) * size[0] + i - 1];
        values[n] = static_cast<float>(static_cast<double>(pixel) - isovalue);
      }
    },
    [this](SizeValueType count, const auto & work) { this->ForEachSlab(count, 0.0f, work, 1024); });
  this->Allocate(surface, lean.GetNumberOfPoints(), lean.GetMostTriangles());
  std::vector<std::uint8_t> areOutside(m_Closed ? 0 : lean.GetNumberOfPoints());
  this->ForEachSlab(planes, 0.5f * share, [&](SizeValueType begin, SizeValueType end) {
    lean.Fill(begin, end, this->IsLeftHanded(), surface, m_Closed ? nullptr : areOutside.data());
  });
  lean.Finish(surface);
  if (!m_Closed)
  {
    auto & triangles = surface.GetTriangles();
    const auto closes = [&areOutside](const TriangleSurface::TriangleType & triangle) {
      return (areOutside[triangle[0]] | areOutside[triangle[1]] | areOutside[triangle[2]]) != 0;
    };
    triangles.erase(std::remove_if(triangles.begin(), triangles.end(), closes), triangles.end());
  }
}

template <typename TInputImage>
template <typename TCount>
auto
FCCIsosurfaceFilter<TInputImage>::CountAndAllocate(const FCCSigns & signs,
                                                   std::uint8_t types,
                                                   const TCount & countTriangles,
                                                   TriangleSurface & surface) -> Layout
{
  const SizeValueType depth = signs.GetDepth();
  Layout layout{ std::vector<SizeValueType>(depth + 1),
                 std::vector<SizeValueType>(depth + 1),
                 std::vector<SizeValueType>(depth + 1) };
  this->ForEachSlab(depth, 0.2f / static_cast<float>(m_Isovalues.size()), [&](SizeValueType begin, SizeValueType end) {
    for (SizeValueType k = begin; k < end; ++k)
    {
      layout.inPlane[k] = FCCCutEdges::Count(signs, FCCCutEdges::Group::InPlane, k, types);
      layout.between[k] = FCCCutEdges::Count(signs, FCCCutEdges::Group::Between, k, types);
      layout.triangles[k] = countTriangles(k);
    }
  });

  SizeValueType points = 0;
  SizeValueType triangles = 0;
  for (SizeValueType k = 0; k <= depth; ++k)
  {
    const SizeValueType afterPlane = points + layout.inPlane[k];
    const SizeValueType afterBetween = afterPlane + layout.between[k];
    const SizeValueType afterTriangles = triangles + layout.triangles[k];
    layout.inPlane[k] = points;
    layout.between[k] = afterPlane;
    layout.triangles[k] = triangles;
    points = afterBetween;
    triangles = afterTriangles;
  }
  this->Allocate(surface, points, triangles);
  return layout;
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::ExtractTetrahedra(const FCCSigns & signs, double isovalue, TriangleSurface & surface)
{
  const SizeValueType depth = signs.GetDepth();
  const Layout layout = this->CountAndAllocate(
    signs,
    FCCCutEdges::AllTypes,
    [&](SizeValueType k) { return k + 1 < depth ? CountTriangles(signs, k) : 0; },
    surface);
  const bool reversed = this->IsLeftHanded();
  const FCCEdgePoints edgePoints = this->MakeEdgePoints();
  const auto idOf = [](SizeValueType id) { return static_cast<std::uint32_t>(id); };

  this->ForEachSlab(depth, 0.7f / static_cast<float>(m_Isovalues.size()), [&](SizeValueType begin, SizeValueType end) {
    FCCEdgePointFiller filler = this->MakeFiller(signs, isovalue, edgePoints);
    FCCCutEdges lower(signs, FCCCutEdges::Group::InPlane);
    FCCCutEdges upper(signs, FCCCutEdges::Group::InPlane);
    FCCCutEdges between(signs, FCCCutEdges::Group::Between);
    lower.Find(begin, idOf(layout.inPlane[begin]));
    for (SizeValueType k = begin; k < end; ++k)
    {
      between.Find(k, idOf(layout.between[k]));
      upper.Find(k + 1, idOf(layout.inPlane[k + 1]));
      filler.Fill(k, lower, between, surface);
      if (k + 1 < depth)
      {
        FillTriangles(signs, k, lower, upper, between, reversed, surface.GetTriangles().data() + layout.triangles[k]);
      }
      std::swap(lower, upper);
    }
  });
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::ExtractCells(const FCCSigns & signs,
                                               double isovalue,
                                               FCCCellScheme scheme,
                                               TriangleSurface & surface)
{
  const std::uint8_t types = GetEdgeTypes(scheme);
  const Layout layout = this->CountAndAllocate(
    signs, types, [&](SizeValueType k) { return CountCellTriangles(signs, scheme, k, m_Closed); }, surface);
  const bool reversed = this->IsLeftHanded();
  const FCCEdgePoints edgePoints = this->MakeEdgePoints();
  const auto idOf = [](SizeValueType id) { return static_cast<std::uint32_t>(id); };

  const float share = 0.7f / static_cast<float>(m_Isovalues.size());
  this->ForEachSlab(signs.GetDepth(), share, [&](SizeValueType begin, SizeValueType end) {
    // Of the planes before, at and after a layer; no edges are cut before the first plane.
    using Group = FCCCutEdges::Group;
    FCCCutEdges inPlane[3] = { { signs, Group::InPlane, types },
                               { signs, Group::InPlane, types },
                               { signs, Group::InPlane, types } };
    FCCCutEdges between[2] = { { signs, Group::Between, types }, { signs, Group::Between, types } };
    if (begin > 0)
    {
      inPlane[0].Find(begin - 1, idOf(layout.inPlane[begin - 1]));
      between[0].Find(begin - 1, idOf(layout.between[begin - 1]));
    }
    inPlane[1].Find(begin, idOf(layout.inPlane[begin]));
    FCCEdgePointFiller filler = this->MakeFiller(signs, isovalue, edgePoints);
    for (SizeValueType k = begin; k < end; ++k)
    {
      between[1].Find(k, idOf(layout.between[k]));
      inPlane[2].Find(k + 1, idOf(layout.inPlane[k + 1]));
      filler.Fill(k, inPlane[1], between[1], surface);
      FillCellTriangles(signs,
                        scheme,
                        k,
                        { { &inPlane[0], &inPlane[1], &inPlane[2] }, { &between[0], &between[1] } },
                        m_Closed,
                        reversed,
                        surface.GetTriangles().data() + layout.triangles[k]);
      std::rotate(std::begin(inPlane), std::begin(inPlane) + 1, std::end(inPlane));
      std::swap(between[0], between[1]);
    }
  });
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
