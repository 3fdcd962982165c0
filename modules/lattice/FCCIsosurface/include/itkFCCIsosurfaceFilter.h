#ifndef itkFCCIsosurfaceFilter_h
#define itkFCCIsosurfaceFilter_h

#include "detail/itkForEachSlab.h"
#include "itkFCCImage.h"
#include "itkFCCRowKernels.h"
#include "itkFCCSurfaceExtractor.h"
#include "itkFCCSurfaceParts.h"
#include "itkInputSamples.h"
#include "itkProcessObject.h"
#include "itkRecyclingMemory.h"
#include "itkWorkProgress.h"
#include "rhombicPixelTypes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
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
 * Pixels may be any integers from char to unsigned long long, float or double; for the types of scans (uint8, int16,
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
 * - Lean (default): each of these points moves to the nearer end of its edge; all of one site become one vertex, so
 *   that triangles straddle the surface of the samples' reconstruction about the site, and triangles that lose a side
 *   vanish. On smooth surfaces that is a third of the triangles of Tetrahedra, and of far better shape, nearer to the
 *   truth than marching cubes. Where it would change the surface's topology (the points of a site form no disk, an edge
 *   would have more than two triangles, or a vertex fewer than three), a site's points gather in parts or stay as in
 *   Fine, so rough surfaces gain less, and noisy surfaces take longer. Triangles of thin parts may pass through each
 *   other, and a speck of few triangles may be inside out: TriangleSurfaceFinishFilter repairs both.
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
  SetInput(const InputImageType * image)
  {
    this->ProcessObject::SetNthInput(0, const_cast<InputImageType *>(image));
  }
  const InputImageType *
  GetInput() const
  {
    return itkDynamicCastInDebugMode<const InputImageType *>(this->GetPrimaryInput());
  }

  /** The surface of the first isovalue, or of the \a n-th. */
  TriangleSurface *
  GetOutput(DataObjectPointerArraySizeType n = 0)
  {
    return itkDynamicCastInDebugMode<TriangleSurface *>(this->ProcessObject::GetOutput(n));
  }
  const TriangleSurface *
  GetOutput(DataObjectPointerArraySizeType n = 0) const
  {
    return itkDynamicCastInDebugMode<const TriangleSurface *>(this->ProcessObject::GetOutput(n));
  }

  /** The values at which surfaces lie, in units of the pixels: at least one, all finite. Default 0. */
  void
  SetIsovalues(const std::vector<double> & isovalues)
  {
    if (isovalues == m_Isovalues)
    {
      return;
    }
    if (isovalues.empty())
    {
      itkExceptionMacro("There must be at least one isovalue; leave the Isovalues at 0 or choose one.");
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

  /** Whether samples below the isovalue are inside instead of samples at or above it. Default off. */
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

  /** Takes surfaces, closed ones, in parts, a slab after the other, so that none is in memory as a whole; the filter's
   * output of such a surface is empty. Must outlive the update. Default null: none is. */
  void
  SetParts(FCCSurfaceParts * parts)
  {
    if (m_Parts != parts)
    {
      m_Parts = parts;
      this->Modified();
    }
  }

protected:
  FCCIsosurfaceFilter()
  {
    this->SetNumberOfRequiredInputs(1);
    this->SetNumberOfRequiredOutputs(1);
    this->ProcessObject::SetNthOutput(0, this->MakeOutput(0));
  }
  ~FCCIsosurfaceFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override
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
    os << indent << "NumberOfStreamDivisions: " << m_NumberOfStreamDivisions << std::endl;
  }

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(DataObjectPointerArraySizeType) override
  {
    return TriangleSurface::New().GetPointer();
  }

  void
  VerifyPreconditions() ITKv5_CONST override
  {
    Superclass::VerifyPreconditions();
    for (const double isovalue : m_Isovalues)
    {
      if (!std::isfinite(isovalue))
      {
        itkExceptionMacro("Isovalue must be a finite number, not " << isovalue
                                                                   << "; choose one in the range of the samples.");
      }
    }
    if (m_Mode > FCCIsosurfaceMode::Lean)
    {
      itkExceptionMacro("There is no Mode number " << static_cast<int>(m_Mode) << "; use one of FCCIsosurfaceMode.");
    }
  }

  void
  GenerateInputRequestedRegion() override
  {
    const SizeValueType depth = this->GetRegion().GetSize(2);
    const_cast<InputImageType *>(this->GetInput())
      ->SetRequestedRegion(this->RegionOf(this->FindDivision(depth, 0), depth, 0));
  }

  void
  CacheInputReleaseDataFlags() override
  {
    m_ReleasesInput = this->GetInput()->ShouldIReleaseData();
    Superclass::CacheInputReleaseDataFlags();
  }

  void
  GenerateData() override
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

private:
  /** MinimumFraction, or more where a point and the edge's end would have the same position in float32. */
  double
  ComputeFraction() const
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

  FCCFrame
  MakeFrame() const
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

  /** The samples of a row in an image's buffer. Rows are counted from the first of the largest possible region. */
  static const PixelType *
  GetRow(const InputImageType & image, SizeValueType j, SizeValueType k)
  {
    const auto & first = image.GetLargestPossibleRegion().GetIndex();
    return image.GetBufferPointer() +
           image.ComputeOffset(
             { { first[0], first[1] + static_cast<IndexValueType>(j), first[2] + static_cast<IndexValueType>(k) } });
  }

  /** The input and an isovalue, as extractors see them. Its readers read the input's buffer when they are called. */
  FCCScalarField
  MakeField(double isovalue, RecyclingMemory & scratch) const
  {
    const InputImageType * const image = this->GetInput();
    const SizeValueType width = this->GetRegion().GetSize(0);
    const auto readRow = [this, image, width, isovalue](SizeValueType j, SizeValueType k, float * values) {
      m_WorkProgress->CheckAbort(); // slabs take long
      FCCRowKernels::Subtract(GetRow(*image, j, k), width, isovalue, values);
    };
    return { this->GetRegion(), this->MakeFrame(), m_InsideIsBelow, m_Closed, m_UsedFraction, readRow, &scratch };
  }

  /** The signs for each isovalue, with a layer of sites outside around the image if \a margin is 1. */
  std::vector<FCCSigns>
  Classify(SizeValueType margin)
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
      std::vector<FCCSigns::WordType> row(signs.front().GetNumberOfWords());
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
            row.back() = 0; // the margin may need a word more than the samples
            FCCRowKernels::Classify(values, region.GetSize(0), m_Isovalues[n], m_InsideIsBelow, row.data());
            if (margin > 0)
            {
              FCCBits::MoveUp(row.data(), row.size());
            }
            signs[n].SetRow(j + margin, k + margin, row.data());
          }
        }
      }
      undefined += undefinedInSlab;
    });
    m_NumberOfUndefinedSamples = undefined;
    return signs;
  }

  /** Makes the surfaces of the isovalues \a first to \a last - 1 in the same passes over the input. */
  void
  Extract(const std::vector<FCCSigns> & signs, std::size_t first, std::size_t last)
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

    std::vector<bool> areInParts(extractors.size());
    for (std::size_t n = first; n < last; ++n)
    {
      FCCSurfaceExtractor & extractor = *extractors[n - first];
      this->Resolve(extractor, shareOfResolve / static_cast<float>(last - first));
      const bool isInParts =
        m_Parts != nullptr && m_Closed && m_Parts->Begin(n, extractor.GetFirstPoints(), this->BoundsOf(signs[n]));
      areInParts[n - first] = isInParts;
      this->Allocate(*this->GetOutput(n), extractor, isInParts);
    }
    scratch.ReleaseSpare(); // filling needs blocks of other sizes
    const auto forEachPart = [&](const auto & use) {
      for (std::size_t n = first; n < last; ++n)
      {
        areInParts[n - first] ? use(n, *extractors[n - first], *this->GetOutput(n)) : void();
      }
    };
    this->ForEachLoadedSlab(
      planes,
      around,
      share - shareOfCount - shareOfResolve,
      [&](SizeValueType begin, SizeValueType end) {
        for (std::size_t n = first; n < last; ++n)
        {
          extractors[n - first]->Fill(begin, end, *this->GetOutput(n));
        }
      },
      [&](const Planes & loaded) {
        forEachPart([&](std::size_t, FCCSurfaceExtractor & extractor, TriangleSurface & part) {
          extractor.SetPlanes(loaded.begin, loaded.end);
          this->Allocate(part, extractor, false);
        });
      },
      [&](const Planes & filled) {
        forEachPart([&](std::size_t n, FCCSurfaceExtractor & extractor, TriangleSurface & part) {
          extractor.Finish(part);
          m_Parts->Take(n, part, filled.end);
          part.Initialize();
        });
      });
    for (std::size_t n = first; n < last; ++n)
    {
      TriangleSurface & surface = *this->GetOutput(n);
      areInParts[n - first] ? void() : extractors[n - first]->Finish(surface);
      if (!m_Closed)
      {
        surface.RemoveUnusedPoints(); // on edges of no cell, at the ragged ends of rows
      }
      surface.Modified();
    }
  }

  /** A box around a surface, with a site around the sites inside. */
  FCCSurfaceParts::Bounds
  BoundsOf(const FCCSigns & signs) const
  {
    const auto found = signs.FindBounds();
    if (!found)
    {
      return {};
    }
    const auto & start = this->GetRegion().GetIndex();
    constexpr double largest = std::numeric_limits<double>::max();
    FCCSurfaceParts::Bounds bounds{ largest, -largest, largest, -largest, largest, -largest };
    for (unsigned int corner = 0; corner < 8; ++corner)
    {
      std::array<double, 3> coordinates{};
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const bool isHigh = (corner >> axis & 1) != 0;
        const auto margin = static_cast<IndexValueType>(FCCSurfaceExtractor::GetMargin(m_Mode, m_Closed));
        const auto index = static_cast<double>(static_cast<IndexValueType>((*found)[2 * axis + (isHigh ? 1 : 0)]) -
                                               margin + start[axis] + (isHigh ? 1 : -1));
        coordinates[axis] = axis == 0 ? 2.0 * index + (isHigh ? 1.0 : 0.0) : index;
      }
      const auto point = this->GetInput()->template TransformLatticeToPhysicalPoint<double>(coordinates);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        bounds[2 * axis] = std::min(bounds[2 * axis], point[axis]);
        bounds[2 * axis + 1] = std::max(bounds[2 * axis + 1], point[axis]);
      }
    }
    return bounds;
  }

  /** \param onlyChecks whether the surface stays empty */
  void
  Allocate(TriangleSurface & surface, const FCCSurfaceExtractor & extractor, bool onlyChecks) const
  {
    const SizeValueType points = extractor.GetNumberOfPoints();
    if (points > std::numeric_limits<std::uint32_t>::max())
    {
      itkExceptionMacro("The surface would have "
                        << points
                        << " points, more than 32-bit indices reach; resample at a lower density, or "
                           "extract from a smaller region.");
    }
    surface.Initialize();
    if (!onlyChecks)
    {
      surface.GetPoints().resize(points);
      surface.GetNormals().resize(m_ComputeNormals ? points : 0);
      surface.GetTriangles().resize(extractor.GetNumberOfTriangles());
    }
  }

  /** The units of progress of the whole update. */
  static constexpr SizeValueType WholeProgress = SizeValueType{ 1 } << 30;

  static SizeValueType
  AmountOf(float share)
  {
    return static_cast<SizeValueType>(share * static_cast<float>(WholeProgress));
  }

  void
  Resolve(FCCSurfaceExtractor & extractor, float share)
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

  /** Planes from \a begin to \a end - 1. */
  struct Planes
  {
    SizeValueType begin;
    SizeValueType end;
  };

  /** The part of the image's \a planes, or of the planes of its signs, that is streamed together with plane \a k. */
  Planes
  FindDivision(SizeValueType planes, SizeValueType k) const
  {
    const SizeValueType depth = std::max<SizeValueType>(1, this->GetRegion().GetSize(2));
    const auto divisions = std::min<SizeValueType>(m_NumberOfStreamDivisions, depth);
    const SizeValueType n = ((k + 1) * divisions - 1) / std::max<SizeValueType>(1, planes);
    return { n * planes / divisions, (n + 1) * planes / divisions };
  }

  /** The image's samples in a division of \a planes and \a around it. */
  ImageRegion<3>
  RegionOf(const Planes & division, SizeValueType planes, SizeValueType around) const
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

  /** Brings the input's samples of a region into its buffer. */
  void
  Load(const ImageRegion<3> & region)
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
        image->ReleaseData(); // so that the next update does not reuse unfinished data
        throw;
      }
    }
    VerifyInputSamples(*this, *image, region);
  }

  /** Loads one division of \a planes after the other, with the planes \a around it, and works at each as ForEachSlab()
   * does. \param before and \param after are called for each division */
  template <typename TWork>
  void
  ForEachLoadedSlab(SizeValueType planes,
                    SizeValueType around,
                    float share,
                    const TWork & work,
                    const std::function<void(const Planes &)> & before = {},
                    const std::function<void(const Planes &)> & after = {})
  {
    for (SizeValueType begin = 0; begin < planes;)
    {
      const Planes division = this->FindDivision(planes, begin);
      m_WorkProgress->CheckAbort();
      this->Load(this->RegionOf(division, planes, around));
      before ? before(division) : void();
      const SizeValueType count = division.end - begin;
      const SizeValueType least = around > 0 && !this->IsInMemory() ? LeastPlanesOfSlab : 1;
      this->ForEachSlab(
        division, share * static_cast<float>(count) / static_cast<float>(planes), work, { least, MostPlanes });
      after ? after(division) : void();
      begin = division.end;
    }
  }

  /** How many planes each thread works at in one go, see itk::ForEachSlab(). */
  struct PlanesInOneGo
  {
    SizeValueType least;
    SizeValueType most;
  };
  static constexpr SizeValueType MostPlanes = 64;

  /** Each thread keeps about 20 planes around the planes that it works at: with slabs of this size, all threads
   * together keep about twice the planes that are loaded, however many threads there are. */
  static constexpr SizeValueType LeastPlanesOfSlab = 10;

  /** Calls \a work(begin, end) for slabs of planes, by several threads, and reports its share of the progress. */
  template <typename TWork>
  void
  ForEachSlab(const Planes & planes, float share, const TWork & work, const PlanesInOneGo & inOneGo)
  {
    const SizeValueType count = planes.end - planes.begin;
    const SizeValueType amount = AmountOf(share);
    itk::ForEachSlab(*this, count, inOneGo.least, inOneGo.most, [&](SizeValueType begin, SizeValueType end) {
      work(planes.begin + begin, planes.begin + end);
      m_WorkProgress->Completed(amount * end / count - amount * begin / count);
    });
  }

  std::vector<double> m_Isovalues{ 0.0 };
  FCCIsosurfaceMode m_Mode{ FCCIsosurfaceMode::Lean };
  double m_UsedFraction{ MinimumFraction };
  SizeValueType m_NumberOfUndefinedSamples{ 0 };
  bool m_ComputeNormals{ true };
  bool m_InsideIsBelow{ false };
  bool m_Closed{ true };
  unsigned int m_NumberOfStreamDivisions{ 1 };
  FCCSurfaceParts * m_Parts{ nullptr };
  bool m_ReleasesInput{ false };
  std::optional<WorkProgress> m_WorkProgress;
};

// Compiled once, in the library, for the pixel types of scans.
RHOMBIC_INSTANTIATE(extern template class FCCIsosurfaceFilter, FCCImage);

} // namespace itk

#endif
