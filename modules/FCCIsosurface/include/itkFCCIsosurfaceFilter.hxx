#ifndef itkFCCIsosurfaceFilter_hxx
#define itkFCCIsosurfaceFilter_hxx

#include "itkFCCEdgePoints.h"
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
}

template <typename TInputImage>
void
FCCIsosurfaceFilter<TInputImage>::GenerateData()
{
  this->UpdateProgress(0.0f);
  this->GetOutput()->Initialize();
  m_UsedFraction = this->ComputeFraction();
  const FCCSigns signs = this->Classify();
  this->Fill(signs, this->Count(signs));
  if (!m_Closed)
  {
    this->GetOutput()->RemoveUnusedPoints(); // on edges of no tetrahedron, at the ragged ends of rows
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

  this->ForEachSlab(region.GetSize(2), 0.1f, [&](SizeValueType begin, SizeValueType end) {
    for (SizeValueType k = begin; k < end; ++k)
    {
      for (SizeValueType j = 0; j < region.GetSize(1); ++j)
      {
        const PixelType * const values = image->GetBufferPointer() + (k * region.GetSize(1) + j) * region.GetSize(0);
        FCCSigns::WordType * const row = signs.GetRow(j + padding, k + padding);
        FCCRowKernels::Classify(values, region.GetSize(0), m_Isovalue, m_InsideIsBelow, row);
        if (m_Closed)
        {
          signs.ShiftRow(j + padding, k + padding);
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
  this->ForEachSlab(depth, 0.2f, [&](SizeValueType begin, SizeValueType end) {
    for (SizeValueType k = begin; k < end; ++k)
    {
      layout.inPlane[k] = FCCCutEdges::Count(signs, FCCCutEdges::Group::InPlane, k);
      layout.between[k] = FCCCutEdges::Count(signs, FCCCutEdges::Group::Between, k);
      layout.triangles[k] = k + 1 < depth ? CountTriangles(signs, k) : 0;
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
  const InputImageType * const image = this->GetInput();
  const ImageRegion<3> & region = image->GetBufferedRegion();
  const SizeValueType margin = m_Closed ? 1 : 0;
  const FCCEdgePoints edgePoints(region, this->MakeFrame(), false, m_UsedFraction, margin);
  const auto readRow = [&](SizeValueType j, SizeValueType k, float * values) {
    FCCRowKernels::Subtract(image->GetBufferPointer() + (k * region.GetSize(1) + j) * region.GetSize(0),
                            region.GetSize(0),
                            m_Isovalue,
                            values);
  };
  const auto idOf = [](SizeValueType id) { return static_cast<std::uint32_t>(id); };

  this->ForEachSlab(depth, 0.7f, [&](SizeValueType begin, SizeValueType end) {
    FCCCutEdges lower(signs, FCCCutEdges::Group::InPlane);
    FCCCutEdges upper(signs, FCCCutEdges::Group::InPlane);
    FCCCutEdges between(signs, FCCCutEdges::Group::Between);
    FCCFieldPlanes field({ region.GetSize(0), region.GetSize(1), region.GetSize(2) },
                         FCCLattice::Parity(region.GetIndex(1) - 1, region.GetIndex(2) - 1),
                         readRow);
    std::vector<bool> wanted(signs.GetHeight() * 1000, true);
    lower.Find(begin, idOf(layout.inPlane[begin]));
    for (SizeValueType k = begin; k < end; ++k)
    {
      between.Find(k, idOf(layout.between[k]));
      upper.Find(k + 1, idOf(layout.inPlane[k + 1]));
      const SizeValueType plane = k + 1 - margin;
      for (SizeValueType near = plane > 0 ? plane - 1 : 0; near <= std::min(plane + 2, region.GetSize(2) + 1); ++near)
      {
        field.LoadValues(near);
      }
      field.LoadGradients(plane, wanted);
      field.LoadGradients(plane + 1, wanted);
      edgePoints.Place(signs, lower, k, field, surface->GetPoints().data(), surface->GetNormals().data());
      edgePoints.Place(signs, between, k, field, surface->GetPoints().data(), surface->GetNormals().data());
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
