#ifndef itkTriangleSurface_h
#define itkTriangleSurface_h

#include "itkBulkAllocator.h"
#include "itkDataObject.h"
#include "itkObjectFactory.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace itk
{

/** \class TriangleSurface
 * \brief A compact triangle mesh: 12 bytes per point, 12 per normal, 12 per triangle.
 *
 * Points and normals are float32 triples and triangles are uint32 index triples, each in one contiguous array that
 * file writers and graphics libraries take without a copy; SurfaceToPolyData() of SurfaceVTK shares them with VTK.
 * itk::Mesh, which allocates every cell on the heap, takes 8 times the memory and itk::QuadEdgeMesh 50 times; see
 * ConvertTriangleSurfaceToMesh() and ConvertTriangleSurfaceToQuadEdgeMesh().
 *
 * Surfaces share their arrays after Graft(), and so do the vtkPolyData of SurfaceToPolyData(). A shared array never
 * changes: accessors of a surface that is not const copy it first, if another object holds it, and Initialize()
 * replaces it. So read through a reference or pointer to a const surface: several threads at a time, and without a
 * copy. A reference from GetPoints(), GetNormals() or GetTriangles() holds until Graft() or Initialize(), or until its
 * array is shared.
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
  using PointsContainer = BulkVector<PointType>;
  using NormalsContainer = BulkVector<NormalType>;
  using TrianglesContainer = BulkVector<TriangleType>;

  /** Call Modified() after changing an array through a non-const accessor. */
  PointsContainer &
  GetPoints()
  {
    return m_Points.Change();
  }
  const PointsContainer &
  GetPoints() const
  {
    return m_Points.Get();
  }
  NormalsContainer &
  GetNormals()
  {
    return m_Normals.Change();
  }
  const NormalsContainer &
  GetNormals() const
  {
    return m_Normals.Get();
  }
  TrianglesContainer &
  GetTriangles()
  {
    return m_Triangles.Change();
  }
  const TrianglesContainer &
  GetTriangles() const
  {
    return m_Triangles.Get();
  }

  /** The arrays themselves, to hold on to: they stay as they are, whatever happens to the surface. */
  std::shared_ptr<const PointsContainer>
  SharePoints() const
  {
    return m_Points.Share();
  }
  /** As SharePoints(). */
  std::shared_ptr<const NormalsContainer>
  ShareNormals() const
  {
    return m_Normals.Share();
  }
  /** As SharePoints(). */
  std::shared_ptr<const TrianglesContainer>
  ShareTriangles() const
  {
    return m_Triangles.Share();
  }

  SizeValueType
  GetNumberOfPoints() const
  {
    return this->GetPoints().size();
  }
  SizeValueType
  GetNumberOfTriangles() const
  {
    return this->GetTriangles().size();
  }

  /** Whether there is one normal for each point. */
  bool
  HasNormals() const
  {
    return !this->GetPoints().empty() && this->GetNormals().size() == this->GetPoints().size();
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

  /** Shares the arrays of another TriangleSurface. */
  void
  Graft(const DataObject * data) override;

protected:
  TriangleSurface() = default;
  ~TriangleSurface() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  /** An array that its copies share. A copy that changes it takes an array of its own first. */
  template <typename TContainer>
  class SharedArray
  {
  public:
    /** The array, to be read. */
    const TContainer &
    Get() const
    {
      return *m_Array;
    }
    /** The array, to be changed; a copy of it if others hold it. */
    TContainer &
    Change()
    {
      if (m_Array.use_count() > 1)
      {
        m_Array = std::make_shared<TContainer>(*m_Array);
      }
      return *m_Array;
    }
    /** The array, to be held on to. */
    std::shared_ptr<const TContainer>
    Share() const
    {
      return m_Array;
    }

  private:
    std::shared_ptr<TContainer> m_Array = std::make_shared<TContainer>();
  };

private:
  SharedArray<PointsContainer> m_Points;
  SharedArray<NormalsContainer> m_Normals;
  SharedArray<TrianglesContainer> m_Triangles;
};

} // namespace itk

#endif
