#ifndef itkFCCIsosurfaceFilter_h
#define itkFCCIsosurfaceFilter_h

#include "itkFCCImage.h"
#include "itkFCCCellMarching.h"
#include "itkFCCIsosurfaceMode.h"
#include "itkProcessObject.h"
#include "itkThreadFailure.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** \class FCCIsosurfaceFilter
 * \brief The isosurface of an FCC image, by marching the six tetrahedra of each of the lattice's parallelepipeds.
 *
 * A sample is inside when its value is not below the isovalue, or with InsideIsBelow on, when it is (for lungs and
 * other air); not-a-number is outside. Triangles are counter-clockwise seen from outside, points are in LPS mm. There
 * is one point on each cut edge of the tetrahedra, shared by all its triangles, where the values' linear interpolation
 * crosses the isovalue, but at least MinimumFraction of the edge away from both ends (more where 32-bit positions need
 * it): so no triangle is degenerate, even where samples equal the isovalue.
 *
 * Each point has a normal: the gradient from the twelve neighbours, sum d f(x + d) / 8, at the edge's two ends,
 * blended, and pointing outside; on the faces of the image's extent it is that of the face. In noise, where the
 * gradient says little about the next edge, normals and triangles may disagree.
 *
 * All faces of the tetrahedra are triangles, so nothing is ambiguous. With Closed on (the default) everything beyond
 * the image counts as outside, and where a body reaches the border, the surface closes on the faces of the image's
 * extent (see FCCImage), so that it encloses what the samples' Voronoi cells enclose: the surface is a closed oriented
 * manifold for any input. With Closed off the surface ends at the outermost tetrahedra: edges are manifold still, but
 * where two of its parts end at one point of the border, they share that point.
 *
 * Method: Y. Sahillioglu, "A marching algorithm for isosurface extraction from face-centered cubic lattices", Turk J
 * Elec Eng & Comp Sci 25 (2017), in passes that count, prefix-sum and fill as W. Schroeder et al., "Flying Edges"
 * (2015) do for Cartesian grids: classify samples into bits; count cut edges and triangles of each plane by counting
 * bits; from the sums, fill points and triangles of all planes independently. The output has the same bytes for any
 * number of threads.
 *
 * Memory: the surface, a bit for each sample (rows are rounded up to words of 64 and have a spare one), and the cut
 * edges of three planes per thread.
 *
 * Throws when the surface has 2^32 points or more, or when 32-bit positions can't tell its points apart. An isovalue
 * outside the image's range gives an empty surface.
 *
 * The whole input is requested.
 *
 * \ingroup FCCIsosurface
 */
template <typename TInputImage>
class ITK_TEMPLATE_EXPORT FCCIsosurfaceFilter : public ProcessObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCIsosurfaceFilter);

  using Self = FCCIsosurfaceFilter;
  using Superclass = ProcessObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCIsosurfaceFilter, ProcessObject);

  using InputImageType = TInputImage;
  using PixelType = typename TInputImage::PixelType;

  static_assert(std::is_base_of<FCCImage<PixelType>, TInputImage>::value, "The input must be an FCCImage");

  /** Nearest that a point comes to the ends of its edge, as a fraction of it. */
  static constexpr double MinimumFraction = 1.0 / 1024.0;

  using Superclass::SetInput;
  void
  SetInput(const InputImageType * image);
  const InputImageType *
  GetInput() const;

  using Superclass::GetOutput;
  TriangleSurface *
  GetOutput();
  const TriangleSurface *
  GetOutput() const;

  /** The value at which the surface lies, in units of the pixels. Default 0. */
  itkSetMacro(Isovalue, double);
  itkGetConstMacro(Isovalue, double);

  /** Whether samples below the isovalue are inside instead of those at or above it. Default off. */
  itkSetMacro(InsideIsBelow, bool);
  itkGetConstMacro(InsideIsBelow, bool);
  itkBooleanMacro(InsideIsBelow);

  /** Whether the surface is closed where a body reaches the image's border. Default on. */
  itkSetMacro(Closed, bool);
  itkGetConstMacro(Closed, bool);
  itkBooleanMacro(Closed);

  /** The cells that are marched. Default Tetrahedra. */
  itkSetEnumMacro(Mode, FCCIsosurfaceMode);
  itkGetEnumMacro(Mode, FCCIsosurfaceMode);

protected:
  FCCIsosurfaceFilter();
  ~FCCIsosurfaceFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(DataObjectPointerArraySizeType index) override;

  void
  VerifyPreconditions() ITKv5_CONST override;

  void
  GenerateData() override;

private:
  /** First point and triangle of each plane, and the totals at the end. */
  struct Layout
  {
    std::vector<SizeValueType> inPlane;   ///< ids of points on edges within a plane begin here
    std::vector<SizeValueType> between;   ///< ids of points on edges to the next plane begin here
    std::vector<SizeValueType> triangles; ///< triangles between a plane and the next, or of a layer of cells
  };

  bool
  MarchesWholeCells() const
  {
    return m_Mode == FCCIsosurfaceMode::Octahedra || m_Mode == FCCIsosurfaceMode::Parallelepipeds;
  }

  FCCCellScheme
  GetCellScheme() const
  {
    return m_Mode == FCCIsosurfaceMode::Octahedra ? FCCCellScheme::Octahedra : FCCCellScheme::Parallelepipeds;
  }

  /** The types of edges with points. */
  std::uint8_t
  GetUsedEdgeTypes() const
  {
    return this->MarchesWholeCells() ? GetEdgeTypes(this->GetCellScheme()) : FCCCutEdges::AllTypes;
  }

  /** MinimumFraction, or more where positions in float32 would not tell a point from the edge's end. */
  double
  ComputeFraction() const;

  FCCSigns
  Classify();

  Layout
  Count(const FCCSigns & signs);

  void
  Fill(const FCCSigns & signs, const Layout & layout);

  /** Fill(), for whole cells. */
  void
  FillCells(const FCCSigns & signs, const Layout & layout);

  void
  FillPoints(const FCCSigns & signs, const FCCCutEdges & edges, FCCCutEdges::Group group, SizeValueType plane);

  /** Calls \a work(begin, end) for slabs of planes, by several threads, and reports its share of the progress. */
  template <typename TWork>
  void
  ForEachSlab(SizeValueType planes, float share, const TWork & work);

  double m_Isovalue{ 0.0 };
  double m_UsedFraction{ MinimumFraction };
  bool m_InsideIsBelow{ false };
  bool m_Closed{ true };
  FCCIsosurfaceMode m_Mode{ FCCIsosurfaceMode::Tetrahedra };
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkFCCIsosurfaceFilter.hxx"
#endif

// Compiled once, in the library, for the pixel types of scans.
namespace itk
{
extern template class FCCIsosurfaceFilter<FCCImage<std::uint8_t>>;
extern template class FCCIsosurfaceFilter<FCCImage<std::int16_t>>;
extern template class FCCIsosurfaceFilter<FCCImage<std::uint16_t>>;
extern template class FCCIsosurfaceFilter<FCCImage<std::int32_t>>;
extern template class FCCIsosurfaceFilter<FCCImage<float>>;
} // namespace itk

#endif
