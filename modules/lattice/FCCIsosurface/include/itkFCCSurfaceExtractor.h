#ifndef itkFCCSurfaceExtractor_h
#define itkFCCSurfaceExtractor_h

#include "itkFCCIsosurfaceMode.h"
#include "itkFCCSigns.h"
#include "itkImageRegion.h"
#include "itkTriangleSurface.h"

#include <array>
#include <functional>
#include <memory>
#include <memory_resource>

namespace itk
{

/** \class FCCFrame
 * \brief From lattice coordinates to the world in mm: points by an affine map, gradients by the transposed inverse of
 * it.
 *
 * \ingroup FCCIsosurface
 */
struct FCCFrame
{
  std::array<double, 3> origin;
  std::array<std::array<double, 3>, 3> matrix;          ///< [world axis][lattice axis]
  std::array<std::array<double, 3>, 3> gradientToWorld; ///< [world axis][lattice axis]
  double outwardSign;                                   ///< 1 or -1: the factor with which gradients point outside

  /** Whether the triangles of the tables, in lattice coordinates, would face inwards in the world. */
  bool
  IsLeftHanded() const
  {
    const auto & m = matrix;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]) <
           0.0;
  }
};

/** \class FCCScalarField
 * \brief An FCC image of any pixel type and one isovalue, as extractors see them. Any number of threads may call its
 * readers at once.
 *
 * \ingroup FCCIsosurface
 */
struct FCCScalarField
{
  /** Writes the values of the image's row (\a j, \a k), counted from 0, less the isovalue. */
  using RowReader = std::function<void(SizeValueType j, SizeValueType k, float * values)>;

  ImageRegion<3> region;
  FCCFrame frame;
  bool insideIsBelow;
  bool closed;            ///< whether the surface closes where a body reaches the image's border
  double minimumFraction; ///< least distance of a point from the ends of its edge, relative to the edge
  RowReader readRow;
  std::pmr::memory_resource * scratch; ///< working memory of one call of Count() or Fill(), for any thread
};

/** \class FCCSurfaceExtractor
 * \brief Makes the isosurface of a field in two passes over slabs of its planes: the first counts, the second fills.
 *
 * Count all planes of the signs once, in slabs of any size and order; Resolve once; give the surface room for the
 * points and triangles there may be, and for as many normals, or none; Fill all planes once, in any slabs; Finish once.
 * The bytes do not depend on how planes are divided into slabs. Any number of threads may Count, and later Fill,
 * different slabs at once; the rest is for one thread. After SetPlanes(), which may be called again and again, a
 * surface has room for some planes alone, which are filled and finished.
 *
 * \ingroup FCCIsosurface
 */
class FCCSurfaceExtractor
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCSurfaceExtractor);

  /** The threads that Resolve() works with. */
  struct Workers
  {
    /** Calls work(n) for n from 0 to count - 1, on several threads. \a share is that of Resolve()'s progress. */
    std::function<void(SizeValueType count, float share, const std::function<void(SizeValueType n)> & work)> forEach;

    /** Throws when the filter is to abort. Any thread may call it, from time to time. */
    std::function<void()> checkAbort;
  };

  /** Planes on either side of a slab that are read with it. */
  static constexpr SizeValueType PlanesAround = 3;

  /** Sites around the image that its signs must have, all outside: 1, or 0 where the surface ends at the samples. */
  static SizeValueType
  GetMargin(FCCIsosurfaceMode mode, bool closed);

  /** \param signs of the field's samples, with GetMargin() sites around them; must outlive the extractor */
  static std::unique_ptr<FCCSurfaceExtractor>
  Make(FCCIsosurfaceMode mode, const FCCSigns & signs, const FCCScalarField & field);

  virtual ~FCCSurfaceExtractor() = default;

  /** Whether Count() reads samples; otherwise the signs are enough. */
  virtual bool
  CountReadsSamples() const
  {
    return false;
  }

  /** Counts the points and triangles of planes. */
  virtual void
  Count(SizeValueType begin, SizeValueType end) = 0;

  /** Finds from the counts where the points and triangles of each plane begin. Reads no samples. */
  virtual void
  Resolve(const Workers &)
  {
    this->SumUp();
  }

  /** The number of the first point of each plane, and that of all points, known once resolved. */
  const std::vector<SizeValueType> &
  GetFirstPoints() const
  {
    return m_FirstPoint;
  }

  /** Chooses the planes whose points and triangles the surface to fill has: at first all. Triangles have the numbers
   * that points have in the whole surface, and may use points of the planes beside them. For closed surfaces. */
  void
  SetPlanes(SizeValueType begin, SizeValueType end)
  {
    m_Begin = begin;
    m_End = end;
  }

  /** The number of points of these planes, known once resolved. */
  SizeValueType
  GetNumberOfPoints() const
  {
    return m_FirstPoint[m_End] - m_FirstPoint[m_Begin];
  }

  /** The number of triangles of these planes before Finish(), known once resolved. */
  SizeValueType
  GetNumberOfTriangles() const
  {
    return m_FirstTriangle[m_End] - m_FirstTriangle[m_Begin];
  }

  /** Makes the points and triangles of planes. */
  virtual void
  Fill(SizeValueType begin, SizeValueType end, TriangleSurface & surface) = 0;

  /** Removes triangles that close a surface which is to be open. */
  virtual void
  Finish(TriangleSurface &)
  {}

protected:
  FCCSurfaceExtractor(const FCCSigns & signs, const FCCScalarField & field)
    : m_Signs(signs)
    , m_Field(field)
    , m_FirstPoint(signs.GetDepth() + 1)
    , m_FirstTriangle(signs.GetDepth() + 1)
    , m_End(signs.GetDepth())
  {}

  /** Turns the counts of points and triangles into the numbers before each plane. */
  void
  SumUp();

  /** Where the surface to fill has a point, of whose number in the whole surface it is told. */
  SizeValueType
  PlaceOfPoint(SizeValueType number) const
  {
    return number - m_FirstPoint[m_Begin];
  }

  /** As PlaceOfPoint(), of the first triangle of plane \a k. */
  SizeValueType
  PlaceOfTriangles(SizeValueType k) const
  {
    return m_FirstTriangle[k] - m_FirstTriangle[m_Begin];
  }

  const FCCSigns & m_Signs;
  FCCScalarField m_Field;
  std::vector<SizeValueType> m_FirstPoint;    ///< by plane: the count until Resolve(); at the end the sum
  std::vector<SizeValueType> m_FirstTriangle; ///< the same for triangles
  SizeValueType m_Begin = 0;                  ///< the planes of the surface to fill
  SizeValueType m_End;                        ///< and the plane behind them
};

} // namespace itk

#endif
