#ifndef itkFCCIsosurfaceFilter_hxx
#define itkFCCIsosurfaceFilter_hxx

#include "itkFCCEdgePoint.h"
#include "itkMultiThreaderBase.h"

#include <algorithm>
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
FCCIsosurfaceFilter<TInputImage>::GetOutput()
{
  return itkDynamicCastInDebugMode<TriangleSurface *>(this->GetPrimaryOutput());
}

template <typename TInputImage>
const TriangleSurface *
FCCIsosurfaceFilter<TInputImage>::GetOutput() const
{
  return itkDynamicCastInDebugMode<const TriangleSurface *>(this->GetPrimaryOutput());
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
  os << indent << "Isovalue: " << m_Isovalue << std::endl;
  os << indent << "InsideIsBelow: " << (m_InsideIsBelow ? "On" : "Off") << std::endl;
  os << indent << "Closed: " << (m_Closed ? "On" : "Off") << std::endl;
  os << indent << "Mode: " << m_Mode << std::endl;
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::VerifyPreconditions() ITKv5_CONST
{
  Superclass::VerifyPreconditions();
  if (!std::isfinite(m_Isovalue))
  {
    itkExceptionMacro("Isovalue must be a finite number, not " << m_Isovalue << ".");
  }
  if (m_Mode != FCCIsosurfaceMode::Tetrahedra && !this->MarchesWholeCells())
  {
    itkExceptionMacro("Mode " << m_Mode << " is not available; use Tetrahedra, Octahedra or Parallelepipeds.");
  }
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::GenerateData()
{
  this->UpdateProgress(0.0f);
  this->GetOutput()->Initialize();
  m_UsedFraction = this->ComputeFraction();
  const FCCSigns signs = this->Classify();
  const Layout layout = this->Count(signs);
  if (this->MarchesWholeCells())
  {
    this->FillCells(signs, layout);
  }
  else
  {
    this->Fill(signs, layout);
  }
  if (!m_Closed)
  {
    this->GetOutput()->RemoveUnusedPoints(); // on edges of no marched cell, at the ragged ends of rows
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
FCCIsosurfaceFilter<TInputImage>::ForEachSlab(SizeValueType planes, float share, const TWork & work)
{
  // Slabs share the work of finding cut edges at their borders: few planes keep threads busy, many save work.
  constexpr SizeValueType mostPlanes = 16;
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
FCCSigns
FCCIsosurfaceFilter<TInputImage>::Classify()
{
  const InputImageType * const image = this->GetInput();
  const auto & region = image->GetBufferedRegion();
  const SizeValueType padding = m_Closed ? 1 : 0;
  const auto shift = static_cast<IndexValueType>(padding);
  FCCSigns signs(region.GetSize(0) + 2 * padding,
                 region.GetSize(1) + 2 * padding,
                 region.GetSize(2) + 2 * padding,
                 FCCLattice::Parity(region.GetIndex(1) - shift, region.GetIndex(2) - shift));

  const auto isovalue = m_Isovalue;
  const bool isBelow = m_InsideIsBelow;
  this->ForEachSlab(region.GetSize(2), 0.1f, [&](SizeValueType begin, SizeValueType end) {
    for (SizeValueType k = begin; k < end; ++k)
    {
      for (SizeValueType j = 0; j < region.GetSize(1); ++j)
      {
        const PixelType * const values = image->GetBufferPointer() + (k * region.GetSize(1) + j) * region.GetSize(0);
        FCCSigns::WordType * const row = signs.GetRow(j + padding, k + padding);
        for (SizeValueType i = 0; i < region.GetSize(0); ++i)
        {
          const SizeValueType bit = i + padding;
          const auto value = static_cast<double>(values[i]);
          const bool inside = isBelow ? value < isovalue : value >= isovalue;
          row[bit / FCCSigns::WordBits] |= static_cast<FCCSigns::WordType>(inside) << (bit % FCCSigns::WordBits);
        }
      }
    }
  });
  return signs;
}

template <typename TInputImage>
auto
FCCIsosurfaceFilter<TInputImage>::Count(const FCCSigns & signs) -> Layout
{
  const SizeValueType depth = signs.GetDepth();
  Layout layout{ std::vector<SizeValueType>(depth + 1),
                 std::vector<SizeValueType>(depth + 1),
                 std::vector<SizeValueType>(depth + 1) };
  const std::uint8_t types = this->GetUsedEdgeTypes();
  this->ForEachSlab(depth, 0.2f, [&](SizeValueType begin, SizeValueType end) {
    for (SizeValueType k = begin; k < end; ++k)
    {
      layout.inPlane[k] = FCCCutEdges::Count(signs, FCCCutEdges::Group::InPlane, k, types);
      layout.between[k] = FCCCutEdges::Count(signs, FCCCutEdges::Group::Between, k, types);
      if (this->MarchesWholeCells())
      {
        layout.triangles[k] = CountCellTriangles(signs, this->GetCellScheme(), k, m_Closed);
      }
      else
      {
        layout.triangles[k] = k + 1 < depth ? CountTriangles(signs, k) : 0;
      }
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
  if (points > std::numeric_limits<std::uint32_t>::max())
  {
    itkExceptionMacro("The surface would have "
                      << points
                      << " points, more than 32-bit indices reach; resample at a lower density, or "
                         "extract from a smaller region.");
  }
  return layout;
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::Fill(const FCCSigns & signs, const Layout & layout)
{
  const SizeValueType depth = signs.GetDepth();
  TriangleSurface * const surface = this->GetOutput();
  surface->GetPoints().resize(layout.inPlane[depth]);
  surface->GetNormals().resize(layout.inPlane[depth]);
  surface->GetTriangles().resize(layout.triangles[depth]);

  // With left-handed axes the triangles of the tables face inwards.
  const auto & direction = this->GetInput()->GetDirection();
  const bool reversed = vnl_determinant(direction.GetVnlMatrix()) < 0.0;
  const auto idOf = [](SizeValueType id) { return static_cast<std::uint32_t>(id); };

  this->ForEachSlab(depth, 0.7f, [&](SizeValueType begin, SizeValueType end) {
    FCCCutEdges lower(signs, FCCCutEdges::Group::InPlane);
    FCCCutEdges upper(signs, FCCCutEdges::Group::InPlane);
    FCCCutEdges between(signs, FCCCutEdges::Group::Between);
    lower.Find(begin, idOf(layout.inPlane[begin]));
    for (SizeValueType k = begin; k < end; ++k)
    {
      between.Find(k, idOf(layout.between[k]));
      upper.Find(k + 1, idOf(layout.inPlane[k + 1]));
      this->FillPoints(signs, lower, FCCCutEdges::Group::InPlane, k);
      this->FillPoints(signs, between, FCCCutEdges::Group::Between, k);
      if (k + 1 < depth)
      {
        FillTriangles(signs, k, lower, upper, between, reversed, surface->GetTriangles().data() + layout.triangles[k]);
      }
      std::swap(lower, upper);
    }
  });
  surface->Modified();
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::FillCells(const FCCSigns & signs, const Layout & layout)
{
  const SizeValueType depth = signs.GetDepth();
  TriangleSurface * const surface = this->GetOutput();
  surface->GetPoints().resize(layout.inPlane[depth]);
  surface->GetNormals().resize(layout.inPlane[depth]);
  surface->GetTriangles().resize(layout.triangles[depth]);

  // With left-handed axes the triangles of the tables face inwards.
  const auto & direction = this->GetInput()->GetDirection();
  const bool reversed = vnl_determinant(direction.GetVnlMatrix()) < 0.0;
  const std::uint8_t types = this->GetUsedEdgeTypes();
  const auto idOf = [](SizeValueType id) { return static_cast<std::uint32_t>(id); };

  this->ForEachSlab(depth, 0.7f, [&](SizeValueType begin, SizeValueType end) {
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
    for (SizeValueType k = begin; k < end; ++k)
    {
      between[1].Find(k, idOf(layout.between[k]));
      inPlane[2].Find(k + 1, idOf(layout.inPlane[k + 1]));
      this->FillPoints(signs, inPlane[1], Group::InPlane, k);
      this->FillPoints(signs, between[1], Group::Between, k);
      FillCellTriangles(signs,
                        this->GetCellScheme(),
                        k,
                        { { &inPlane[0], &inPlane[1], &inPlane[2] }, { &between[0], &between[1] } },
                        m_Closed,
                        reversed,
                        surface->GetTriangles().data() + layout.triangles[k]);
      std::rotate(std::begin(inPlane), std::begin(inPlane) + 1, std::end(inPlane));
      std::swap(between[0], between[1]);
    }
  });
  surface->Modified();
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::FillPoints(const FCCSigns & signs,
                                             const FCCCutEdges & edges,
                                             FCCCutEdges::Group group,
                                             SizeValueType plane)
{
  const InputImageType * const image = this->GetInput();
  const auto first = image->GetBufferedRegion().GetIndex();
  const IndexValueType shift = m_Closed ? 1 : 0;
  const FCCEdgePoint<InputImageType> edgePoint(*image, m_Isovalue, m_InsideIsBelow, m_UsedFraction);
  TriangleSurface * const surface = this->GetOutput();

  for (SizeValueType j = 0; j < signs.GetHeight(); ++j)
  {
    for (std::uint8_t type = FCCCutEdges::FirstType(group); type <= FCCCutEdges::LastType(group); ++type)
    {
      if (!edges.HasType(type))
      {
        continue;
      }
      const FCCCutEdges::Row row = edges.GetRow(j, type);
      for (SizeValueType word = 0; word < signs.GetNumberOfWords(); ++word)
      {
        std::uint32_t id = row.before[word];
        for (auto mask = row.mask[word]; mask != 0; mask &= mask - 1)
        {
          const auto i = static_cast<IndexValueType>(word * FCCSigns::WordBits) + __builtin_ctzll(mask);
          const Index<3> index{ { first[0] + i - shift,
                                  first[1] + static_cast<IndexValueType>(j) - shift,
                                  first[2] + static_cast<IndexValueType>(plane) - shift } };
          edgePoint.Place(FCCLattice::SiteOf(index),
                          FCCLattice::OwnedEdges[type],
                          surface->GetPoints()[id],
                          surface->GetNormals()[id]);
          ++id;
        }
      }
    }
  }
}

} // namespace itk

#endif
