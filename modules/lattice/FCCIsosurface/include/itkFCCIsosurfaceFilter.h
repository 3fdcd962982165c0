#ifndef itkFCCIsosurfaceFilter_h
#define itkFCCIsosurfaceFilter_h

#include "itkFCCImage.h"
#include "itkFCCSurfaceExtractor.h"
#include "itkProcessObject.h"
#include "itkRecyclingMemory.h"
#include "itkWorkProgress.h"
#include "rhombicPixelTypes.h"

#include <limits>
#include <optional>

namespace itk
{

/** \class FCCIsosurfaceFilter
 * \brief Isosurfaces of an FCC image, by marching the lattice's cells.
 *
 * A sample is inside when its value is not below the isovalue, or with InsideIsBelow on, when it is (for lungs and
 * other air); not-a-number is outside and counted. Triangles are counter-clockwise seen from outside, points are in LPS
 * mm. One output for each isovalue, in their order.
 *
 * Pixels may be any integers from char to unsigned long long, float or double; for those of scans (uint8, int16,
 * uint16, int32 and float) the filter is compiled in the library. Whether a sample is inside is exact for all types.
 * Between samples, and for normals, differences from the isovalue count as float32 has them; those of 64-bit integers
 * beyond 2^53 may be rounded to 0 before, as those of doubles below 1e-45 are: then points are still on cut edges, but
 * may be anywhere on them.
 *
 * What is between the samples depends on the mode, see FCCIsosurfaceMode:
 * - Tetrahedra, Octahedra, Parallelepipeds: there is one point on each cut edge of the cells, where linear
 *   interpolation crosses the isovalue.
 * - Fine: the tetrahedra, with points where the cubic through four samples on the edge's line crosses the isovalue. On
 *   the longer edges along x, the cubic also passes through the value in the edge's middle, interpolated from the sites
 *   around it.
 * - Lean (default): each of these points moves to the nearer end of its edge; those of one site become one vertex, so
 *   that triangles straddle the surface of the samples' reconstruction about the site, and triangles that lose a side
 *   vanish. On smooth surfaces that is a third of the triangles of Tetrahedra, and of far better shape, nearer to the
 *   truth than marching cubes. Where it would change the surface's topology (the points of a site form no disk, an edge
 *   would have more than two triangles, or a vertex fewer than three), a site's points gather in parts or stay as in
 *   Fine, so rough surfaces gain less, and noisy ones take longer. Triangles of thin parts may pass through each other,
 *   and a speck of few triangles may be inside out: TriangleSurfaceFinishFilter repairs both.
 * Points on edges stay at least MinimumFraction of the edge away from both ends (more where 32-bit positions need it):
 * so no triangle is degenerate, even where samples equal the isovalue.
 *
 * Each point has a normal, unless ComputeNormals is off: the gradient, pointing outside, of the box spline that quasi-
 * interpolates the samples, with coefficients 3/2 f - 1/24 (sum of the 12 neighbours' f) (M. Kim, A. Entezari, J.
 * Peters, "Box spline reconstruction on the face-centered cubic lattice", 2008): at the edge's two ends, blended; for
 * Lean at the vertex, by the expansion about its site to the second order; on the faces of the image's extent it is
 * that of the face. In noise, where gradients change from edge to edge, normals and triangles may disagree.
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
 * Memory: the surface, a bit for each sample and isovalue (rows are rounded up to words of 64 and have a spare one),
 * and about 20 planes of the volume in float32 for each thread that works. Lean also needs at most a byte for each edge
 * that the surface cuts, another bit in the rows with split sites, and 16 bytes for each split site (about 64 while
 * they are found). That is little except in noise, where most sites of the surface are split and it comes to half the
 * size of the surface.
 *
 * **Streaming.** With NumberOfStreamDivisions above 1 the filter asks for the input in that many slabs of planes of
 * constant z, one after the other, with three planes more on either side, so that only a slab of the volume is in
 * memory if the upstream filters can stream. The output has the same bytes. The input is passed over to classify its
 * samples and to fill the surfaces, for Lean also to count before. Upstream filters run again for each slab. From the
 * second slab on, an abort of this filter reaches them at their next ProgressEvent; ITK makes the first slab before
 * this filter's StartEvent: during that time abort the upstream filters themselves, as in any pipeline. A slab is
 * divided among no more threads than it has tens of planes, so that memory hardly grows with their number. Between
 * slabs the input's data are released if its ReleaseDataFlag says so. Afterwards the input's requested region and its
 * buffer are a slab: to have the whole of it, call its UpdateLargestPossibleRegion(). An image without a source is read
 * where it lies.
 *
 * Throws when an isovalue is not finite, when the surface has 2^32 points or more, when its points are too close
 * together for 32-bit positions, or when samples are missing from the input's buffer. An isovalue outside the image's
 * range gives an empty surface.
 *
 * Overridden pipeline methods: VerifyPreconditions() (finite isovalues), GenerateInputRequestedRegion() (the whole
 * input, or the first slab; GenerateData() asks for the others), CacheInputReleaseDataFlags() (to read the flag between
 * slabs).
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
  static_assert(std::is_arithmetic<PixelType>::value && !std::is_same<PixelType, bool>::value &&
                  !std::is_same<PixelType, long double>::value,
                "Pixels must be integers from char to unsigned long long, float or double");

  /** The least distance of a point from the ends of its edge, as a fraction of the edge. */
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

  /** In how many slabs the input is read, one after the other, at most one for each plane. Default 1: all at once. */
  itkSetClampMacro(NumberOfStreamDivisions, unsigned int, 1, std::numeric_limits<unsigned int>::max());
  itkGetConstMacro(NumberOfStreamDivisions, unsigned int);

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
  GenerateInputRequestedRegion() override;

  void
  CacheInputReleaseDataFlags() override;

  void
  GenerateData() override;

private:
  /** MinimumFraction, or more where a point and the edge's end would have the same position in float32. */
  double
  ComputeFraction() const;

  FCCFrame
  MakeFrame() const;

  const ImageRegion<3> &
  GetRegion() const
  {
    return this->GetInput()->GetLargestPossibleRegion();
  }

  bool
  IsInMemory() const
  {
    return this->GetInput()->GetBufferedRegion().IsInside(this->GetRegion());
  }

  /** A sample in an image's buffer, counted from the first of its largest possible region. */
  static const PixelType *
  GetSample(const InputImageType & image, SizeValueType i, SizeValueType j, SizeValueType k);

  /** Its readers read what the input's buffer holds when they are called. */
  FCCScalarField
  MakeField(double isovalue, RecyclingMemory & scratch) const;

  /** The signs for each isovalue, with a layer of sites outside around the image if \a margin is 1. */
  std::vector<FCCSigns>
  Classify(SizeValueType margin);

  /** Makes the surfaces of the isovalues \a first to \a last - 1 in the same passes over the input. */
  void
  Extract(const std::vector<FCCSigns> & signs, std::size_t first, std::size_t last);

  void
  Allocate(TriangleSurface & surface, SizeValueType points, SizeValueType triangles) const;

  /** The units of progress of the whole update. */
  static constexpr SizeValueType WholeProgress = SizeValueType{ 1 } << 30;

  static SizeValueType
  AmountOf(float share)
  {
    return static_cast<SizeValueType>(share * static_cast<float>(WholeProgress));
  }

  void
  Resolve(FCCSurfaceExtractor & extractor, float share);

  /** Planes from \a begin to \a end - 1. */
  struct Planes
  {
    SizeValueType begin;
    SizeValueType end;
  };

  /** The part of the image's planes, or those of its signs, that is streamed together with plane \a k. */
  Planes
  FindDivision(SizeValueType planes, SizeValueType k) const;

  /** The image's samples in a division of \a planes and \a around it. */
  ImageRegion<3>
  RegionOf(const Planes & division, SizeValueType planes, SizeValueType around) const;

  /** Brings the input's samples of a region into its buffer. */
  void
  Load(const ImageRegion<3> & region);

  /** Loads one division of \a planes with those \a around it after the other, and works at each as ForEachSlab() does.
   */
  template <typename TWork>
  void
  ForEachLoadedSlab(SizeValueType planes, SizeValueType around, float share, const TWork & work);

  /** How many planes each thread works at in one go: few keep threads busy, many save work at their borders. */
  struct PlanesInOneGo
  {
    SizeValueType least;
    SizeValueType most;
  };
  static constexpr SizeValueType MostPlanes = 64;

  /** Each thread keeps about 20 planes around those it works at: so they are about twice those of a slab that is
   * loaded, however many threads there are. */
  static constexpr SizeValueType LeastPlanesOfSlab = 10;

  /** Calls \a work(begin, end) for slabs of planes, by several threads, and reports its share of the progress. */
  template <typename TWork>
  void
  ForEachSlab(const Planes & planes, float share, const TWork & work, const PlanesInOneGo & inOneGo);

  std::vector<double> m_Isovalues{ 0.0 };
  FCCIsosurfaceMode m_Mode{ FCCIsosurfaceMode::Lean };
  double m_UsedFraction{ MinimumFraction };
  SizeValueType m_NumberOfUndefinedSamples{ 0 };
  bool m_ComputeNormals{ true };
  bool m_InsideIsBelow{ false };
  bool m_Closed{ true };
  unsigned int m_NumberOfStreamDivisions{ 1 };
  bool m_ReleasesInput{ false };
  std::optional<WorkProgress> m_WorkProgress;
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkFCCIsosurfaceFilter.hxx"
#endif

// Compiled once, in the library, for the pixel types of scans.
namespace itk
{
RHOMBIC_INSTANTIATE(extern template class FCCIsosurfaceFilter, FCCImage);
} // namespace itk

#endif
