#ifndef itkTriangleSurface_h
#define itkTriangleSurface_h

#include "itkBulkAllocator.h"
#include "itkDataObject.h"
#include "itkObjectFactory.h"

#include <array>
#include <cstdint>
#include <vector>

namespace itk
{

/** \class TriangleSurface
 * \brief A triangle mesh that costs what it holds: 12 bytes a point, 12 a normal, 12 a triangle.
 *
 * itk::Mesh allocates every cell on the heap; an isosurface of a scan has millions. Here points and normals are float32
 * triples and triangles are uint32 index triples, each in one contiguous array, ready to be handed to a file writer or
 * a graphics library without a copy: SurfaceToPolyData() of SurfaceVTK shares them with VTK. ConvertToMesh() and
 * ConvertToQuadEdgeMesh() make meshes for ITK's filters, at 8 and 50 times the memory, which they can tell before.
 *
 * Points are in LPS millimetres. Triangles are counter-clockwise seen from outside.
 * Normals are unit vectors pointing outside, one a point, or absent altogether.
 *
 * Thread safety: concurrent readers are safe; a writer needs exclusive access.
 *
 * \ingroup TriangleSurface
 */
class TriangleSurface : public DataObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(TriangleSurface);

  using Self = TriangleSurface;
  using Superclass = DataObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(TriangleSurface, DataObject);

  using PointType = std::array<float, 3>;
  using NormalType = std::array<float, 3>;
  using TriangleType = std::array<std::uint32_t, 3>;
  using PointsContainer = std::vector<PointType, BulkAllocator<PointType>>;
  using NormalsContainer = std::vector<NormalType, BulkAllocator<NormalType>>;
  using TrianglesContainer = std::vector<TriangleType, BulkAllocator<TriangleType>>;

  /** The arrays themselves. After changing one through the non-const accessor, call Modified(). */
  PointsContainer &
  GetPoints()
  {
    return m_Points;
  }
  const PointsContainer &
  GetPoints() const
  {
    return m_Points;
  }
  NormalsContainer &
  GetNormals()
  {
    return m_Normals;
  }
  const NormalsContainer &
  GetNormals() const
  {
    return m_Normals;
  }
  TrianglesContainer &
  GetTriangles()
  {
    return m_Triangles;
  }
  const TrianglesContainer &
  GetTriangles() const
  {
    return m_Triangles;
  }

  SizeValueType
  GetNumberOfPoints() const
  {
    return m_Points.size();
  }
  SizeValueType
  GetNumberOfTriangles() const
  {
    return m_Triangles.size();
  }

  /** Whether there is one normal for each point. */
  bool
  HasNormals() const
  {
    return !m_Points.empty() && m_Normals.size() == m_Points.size();
  }

  /** Bytes held by the three arrays. */
  SizeValueType
  GetMemorySize() const;

  /** Smallest and largest coordinate along each axis in mm: {xmin, xmax, ymin, ymax, zmin, zmax}. All 0 without points.
   */
  std::array<double, 6>
  GetBounds() const;

  /** Drops the points of no triangle, with their normals; the others keep their order. */
  void
  RemoveUnusedPoints();

  /** Back to no points, normals and triangles. */
  void
  Initialize() override;

  /** Takes over a copy of another TriangleSurface's arrays. */
  void
  Graft(const DataObject * data) override;

protected:
  TriangleSurface() = default;
  ~TriangleSurface() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  PointsContainer m_Points;
  NormalsContainer m_Normals;
  TrianglesContainer m_Triangles;
};

} // namespace itk

#endif
