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
 * \brief A compact triangle mesh: 12 bytes per point, 12 per normal, 12 per triangle.
 *
 * Points and normals are float32 triples and triangles are uint32 index triples, each in one contiguous array that
 * file writers and graphics libraries take without a copy; SurfaceToPolyData() of SurfaceVTK shares them with VTK.
 * itk::Mesh, which allocates every cell on the heap, takes 8 times the memory and itk::QuadEdgeMesh 50 times; see
 * ConvertToMesh() and ConvertToQuadEdgeMesh().
 *
 * Points are in LPS millimetres. Triangles are counter-clockwise seen from outside. Normals are unit vectors that
 * point outwards, one per point, or there are none.
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

  /** Call Modified() after changing an array through a non-const accessor. */
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

  /** Bytes in the three arrays. */
  SizeValueType
  GetMemorySize() const;

  /** {xmin, xmax, ymin, ymax, zmin, zmax} in mm; all 0 without points. */
  std::array<double, 6>
  GetBounds() const;

  /** Throws ExceptionObject if a triangle refers to a missing point. */
  void
  VerifyTriangles() const;

  /** Removes points that no triangle uses, with their normals; the others keep their order. */
  void
  RemoveUnusedPoints();

  void
  Initialize() override;

  /** Copies the arrays of another TriangleSurface. */
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
