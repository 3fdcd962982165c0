#ifndef itkFCCIsosurfaceFilter_h
#define itkFCCIsosurfaceFilter_h

#include "itkFCCFieldPlanes.h"
#include "itkFCCImage.h"
#include "itkFCCCellMarching.h"
#include "itkFCCEdgePoints.h"
#include "itkFCCIsosurfaceMode.h"
#include "itkFCCPointKernels.h"
#include "itkProcessObject.h"
#include "itkThreadFailure.h"
#include "itkTriangleSurface.h"

namespace itk
{

/** \class FCCIsosurfaceFilter
 * \brief Isosurfaces of an FCC image, by marching the lattice's cells.
 *
 * A sample is inside when its value is not below the isovalue, or with InsideIsBelow on, when it is (for lungs and
 * other air); not-a-number is outside and counted. Triangles are counter-clockwise seen from outside, points are in LPS
 * mm. One output for each isovalue, in their order; the volume is read once for all.
 *
 * What is between the samples depends on the mode, see FCCIsosurfaceMode:
 * - Tetrahedra, Octahedra, Parallelepipeds: there is one point on each cut edge of the cells, where linear
 *   interpolation crosses the isovalue.
 * - Fine: the tetrahedra with points where the cubic through four samples on the edge's line crosses it, or for the
 *   longer edges along x, one that also passes through the value in their middle, which the sites around tell.
 * - Lean (default): each of these points moves to the nearer end of its edge; those of one site become one vertex, so
 *   that triangles straddle the surface of the samples' reconstruction about the site, and triangles that lose a side
 *   vanish. On smooth surfaces that is a third of the triangles of Tetrahedra, and of far better shape, nearer to the
 *   truth than marching cubes. Where it would change the surface's topology, a site's points gather in parts or stay
 *   as in Fine (see FCCSplitSites), so rough surfaces gain less, and noisy ones take longer. Triangles of thin parts
 *   may pass through each other, and a speck of few triangles may come out inside out: UntangleSurface() and
 *   TurnMisfacingShells() set that right.
 * Points on edges stay at least MinimumFraction of the edge away from both ends (more where 32-bit positions need it):
 * so no triangle is degenerate, even where samples equal the isovalue.
 *
 * Each point has a normal, unless ComputeNormals is off: the gradient of the box spline that quasi-interpolates the
 * samples (see FCCFieldPlanes), at the edge's two ends, blended, or at the vertex (see
 * FCCPointKernels::PlaceClusters()), pointing outside; on the faces of the image's extent it is that of the face. In
 * noise, where the gradient says little about the next edge, normals and triangles may disagree.
 *
 * With Closed on (the default) everything beyond the image counts as outside, and where a body reaches the border, the
 * surface closes on the faces of the image's extent (see FCCImage), so that it encloses what the samples' Voronoi cells
 * enclose. With Closed off the surface ends at the outermost cells: edges are manifold still, but where two of its
 * parts end at one point of the border, they share that point.
 *
 * Method: Y. Sahillioglu, "A marching algorithm for isosurface extraction from face-centered cubic lattices", Turk J
 * Elec Eng & Comp Sci 25 (2017); for Lean G. Treece, R. Prager, A. Gee, "Regularised marching tetrahedra" (1999); in
 * passes that count, prefix-sum and fill as W. Schroeder et al., "Flying Edges" (2015) do for Cartesian grids: classify
 * samples into bits; count points and triangles of each plane; from the sums, fill all planes independently. The output
 * has the same bytes for any number of threads and any processor.
 *
 * Memory: the surface, a bit for each sample and isovalue (rows are rounded up to words of 64 and have a spare one; one
 * more for Lean), and about 20 planes of the volume in float32 for each thread.
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

  /** The surface of the first isovalue, or of the \a n-th. */
  TriangleSurface *
  GetOutput(DataObjectPointerArraySizeType n = 0);
  const TriangleSurface *
  GetOutput(DataObjectPointerArraySizeType n = 0) const;

  /** The values at which surfaces lie, in units of the pixels: at least one, all finite. Default 0. */
  void
  SetIsovalues(const std::vector<double> & isovalues);
  const std::vector<double> &
  GetIsovalues() const
  {
    return m_Isovalues;
  }

  /** One isovalue, or the first of several. */
  void
  SetIsovalue(double isovalue)
  {
    this->SetIsovalues({ isovalue });
  }
  double
  GetIsovalue() const
  {
    return m_Isovalues.front();
  }

  /** How the surface is put through the cells. Default FCCIsosurfaceMode::Lean. */
  itkSetEnumMacro(Mode, FCCIsosurfaceMode);
  itkGetEnumMacro(Mode, FCCIsosurfaceMode);

  /** Whether points get normals. Default on. */
  itkSetMacro(ComputeNormals, bool);
  itkGetConstMacro(ComputeNormals, bool);
  itkBooleanMacro(ComputeNormals);

  /** Samples of the last update that were not a number; they count as outside. */
  itkGetConstMacro(NumberOfUndefinedSamples, SizeValueType);

  /** Whether samples below the isovalue are inside instead of those at or above it. Default off. */
  itkSetMacro(InsideIsBelow, bool);
  itkGetConstMacro(InsideIsBelow, bool);
  itkBooleanMacro(InsideIsBelow);

  /** Whether the surface is closed where a body reaches the image's border. Default on. */
  itkSetMacro(Closed, bool);
  itkGetConstMacro(Closed, bool);
  itkBooleanMacro(Closed);

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
    std::vector<SizeValueType> inPlane; ///< ids of points on edges within a plane begin here
    std::vector<SizeValueType> between; ///< ids of points on edges to the next plane begin here
    std::vector<SizeValueType>
      triangles; ///< triangles between a plane and the next, or of a layer of cells, begin here
  };

  /** MinimumFraction, or more where positions in float32 would not tell a point from the edge's end. */
  double
  ComputeFraction() const;

  FCCFrame
  MakeFrame() const;

  FCCFieldPlanes::RowReader
  MakeRowReader(double isovalue) const;

  FCCEdgePoints
  MakeEdgePoints() const;

  FCCEdgePointFiller
  MakeFiller(const FCCSigns & signs, double isovalue, const FCCEdgePoints & edgePoints) const;

  /** With left-handed axes the triangles of the tables face inwards. */
  bool
  IsLeftHanded() const;

  /** The signs for each isovalue, with a layer of sites outside around the image if \a margin is 1. */
  std::vector<FCCSigns>
  Classify(SizeValueType margin);

  void
  ExtractTetrahedra(const FCCSigns & signs, double isovalue, TriangleSurface & surface);

  void
  ExtractLean(const FCCSigns & signs, double isovalue, TriangleSurface & surface);

  void
  ExtractCells(const FCCSigns & signs, double isovalue, FCCCellScheme scheme, TriangleSurface & surface);

  /** Counts the cut edges of some types, and with them sizes the surface. \a countTriangles(k) says how many triangles
   * the plane or layer k has. */
  template <typename TCount>
  Layout
  CountAndAllocate(const FCCSigns & signs,
                   std::uint8_t types,
                   const TCount & countTriangles,
                   TriangleSurface & surface);

  void
  Allocate(TriangleSurface & surface, SizeValueType points, SizeValueType triangles) const;

  /** Slabs share the work of finding cut edges at their borders: few planes keep threads busy, many save work. */
  static constexpr SizeValueType PlanesOfSlab = 64;

  /** Calls \a work(begin, end) for slabs of planes, by several threads, and reports its share of the progress. */
  template <typename TWork>
  void
  ForEachSlab(SizeValueType planes, float share, const TWork & work, SizeValueType mostPlanes = PlanesOfSlab);

  std::vector<double> m_Isovalues{ 0.0 };
  FCCIsosurfaceMode m_Mode{ FCCIsosurfaceMode::Lean };
  double m_UsedFraction{ MinimumFraction };
  SizeValueType m_NumberOfUndefinedSamples{ 0 };
  bool m_ComputeNormals{ true };
  bool m_InsideIsBelow{ false };
  bool m_Closed{ true };
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
