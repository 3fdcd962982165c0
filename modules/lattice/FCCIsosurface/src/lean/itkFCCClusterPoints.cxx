#include "itkFCCClusterPoints.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace itk
{
namespace
{

using SiteType = FCCLattice::SiteType;

/** How far a vertex moves from its crossings' mean to the surface, in units of the distance of nearest neighbours. */
constexpr float FarthestOfWhole = 0.5f;
constexpr float FarthestOfPart = 0.25f; ///< for the parts of a split site, so that they stay apart

/** The field around the sites of one row in the image. */
class Row
{
public:
  /** \param withFarGradients whether the field has the gradients of the planes on either side, too */
  Row(const FCCFieldPlanes & field, bool withFarGradients)
    : m_Field(field)
    , m_WithFarGradients(withFarGradients)
  {}

  /** Goes to the row (\a j, \a k), unless there already. */
  void
  GoTo(SizeValueType j, SizeValueType k)
  {
    if (m_Values != nullptr && m_J == j && m_K == k)
    {
      return;
    }
    m_J = j;
    m_K = k;
    m_Values = m_Field.GetValues(j, k);
    m_Gradients = m_Field.GetGradients(j, k);
    for (unsigned int direction = 0; direction < FCCCells::Directions; ++direction)
    {
      const SiteType step = FCCCells::StepOf(direction);
      const auto offset = FCCLattice::OffsetOf(step, m_Field.GetParity(j, k));
      const SizeValueType row = j + static_cast<SizeValueType>(offset[1]);
      const SizeValueType plane = k + static_cast<SizeValueType>(offset[2]);
      Neighbor & neighbor = m_Neighbors[direction];
      neighbor.shift = static_cast<SizeValueType>(offset[0]);
      neighbor.values = m_Field.GetValues(j, k, step);
      neighbor.hasGradients = m_WithFarGradients && m_Field.IsReal(1, row) && m_Field.IsReal(2, plane);
      if (neighbor.hasGradients)
      {
        neighbor.gradients = m_Field.GetGradients(row, plane);
      }
    }
  }

  IndexValueType
  GetParity() const
  {
    return m_Field.GetParity(m_J, m_K);
  }
  SizeValueType
  GetJ() const
  {
    return m_J;
  }

  float
  GetValue(SizeValueType i) const
  {
    return m_Values[i];
  }
  float
  GetNeighbor(unsigned int direction, SizeValueType i) const
  {
    return m_Neighbors[direction].values[i];
  }

  /** The gradient's x, y and z. */
  const float *
  GetGradient(SizeValueType i) const
  {
    return m_Gradients.GetGradient(i);
  }

  /** The mean of the gradients at the neighbours in some directions. Neighbours outside the image do not count. */
  std::array<float, 3>
  GetFarGradient(SizeValueType i, unsigned int directions) const
  {
    std::array<float, 3> sum{};
    float count = 0.0f;
    for (; directions != 0; directions &= directions - 1)
    {
      const Neighbor & neighbor = m_Neighbors[__builtin_ctz(directions)];
      const SizeValueType place = i + neighbor.shift;
      if (neighbor.hasGradients && m_Field.IsReal(0, place))
      {
        const float * const gradient = neighbor.gradients.GetGradient(place);
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          sum[axis] += gradient[axis];
        }
        count += 1.0f;
      }
    }
    for (float & component : sum)
    {
      component /= std::max(count, 1.0f);
    }
    return sum;
  }

private:
  /** The row of the neighbours in one direction. */
  struct Neighbor
  {
    SizeValueType shift; ///< from a site to its neighbour
    const float * values;
    bool hasGradients;
    FCCFieldPlanes::GradientRow gradients;
  };

  const FCCFieldPlanes & m_Field;
  bool m_WithFarGradients;
  SizeValueType m_J{ 0 };
  SizeValueType m_K{ 0 };
  const float * m_Values{ nullptr };
  FCCFieldPlanes::GradientRow m_Gradients;
  Neighbor m_Neighbors[FCCCells::Directions];
};

/** Vertices that are placed batch by batch, in order. */
class Output
{
public:
  Output(const FCCFrame & frame,
         const SiteType & origin,
         TriangleSurface::PointType * points,
         TriangleSurface::NormalType * normals,
         std::uint8_t * areOutside)
    : m_Frame(frame)
    , m_Points(points)
    , m_Normals(normals)
    , m_AreOutside(areOutside)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Batch.origin[axis] = static_cast<double>(origin[axis]);
    }
  }

  /** Sets the limits of FCCClusterBatch for the vertices that are added from now on. */
  void
  SetLimits(float minimumFraction, float farthest)
  {
    m_Batch.minimumFraction = minimumFraction;
    m_Batch.farthest = farthest;
  }

  bool
  HasNormals() const
  {
    return m_Normals != nullptr;
  }

  /** Adds the vertex of some crossings of a site of the row. */
  void
  AddCluster(Row & row, SizeValueType i, unsigned int crossings)
  {
    const SizeValueType n = m_Batch.count;
    this->Skip(m_Vertices[n], false);
    m_Batch.value[n] = row.GetValue(i);
    for (unsigned int direction = 0; direction < FCCCells::Directions; ++direction)
    {
      m_Batch.neighbor[direction][n] = row.GetNeighbor(direction, i);
    }
    const float * const gradient = row.GetGradient(i);
    const auto farGradient = this->HasNormals() ? row.GetFarGradient(i, crossings) : std::array<float, 3>{};
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Batch.gradient[axis][n] = gradient[axis];
      m_Batch.farGradient[axis][n] = farGradient[axis];
    }
    m_Batch.crossings[n] = crossings;
    m_Batch.site[0][n] = static_cast<float>(2 * static_cast<IndexValueType>(i) + row.GetParity());
    m_Batch.site[1][n] = static_cast<float>(row.GetJ());
    m_Batch.site[2][n] = 0.0f;
    if (++m_Batch.count == FCCClusterBatch::Capacity)
    {
      this->Flush();
    }
  }

  /** The elements of the surface that a vertex is written to. */
  struct Vertex
  {
    TriangleSurface::PointType * point;
    TriangleSurface::NormalType * normal; ///< or null

    void
    Set(const TriangleSurface::PointType & newPoint, const TriangleSurface::NormalType & newNormal) const
    {
      *point = newPoint;
      if (normal != nullptr)
      {
        *normal = newNormal;
      }
    }
  };

  /** Leaves a vertex out, to be placed later. */
  void
  Skip(Vertex & vertex, bool isOutside)
  {
    vertex = { m_Points++, m_Normals };
    m_Normals += m_Normals != nullptr ? 1 : 0;
    if (m_AreOutside != nullptr)
    {
      *m_AreOutside++ = isOutside ? 1 : 0;
    }
  }

  /** Adds a vertex on the border that has been placed. */
  void
  AddOutside(const TriangleSurface::PointType & point, const TriangleSurface::NormalType & normal)
  {
    Vertex vertex;
    this->Skip(vertex, true);
    vertex.Set(point, normal);
  }

  /** Places the vertices that have been added. */
  void
  Flush()
  {
    if (m_Batch.count == 0)
    {
      return;
    }
    TriangleSurface::PointType points[FCCClusterBatch::Capacity];
    TriangleSurface::NormalType normals[FCCClusterBatch::Capacity];
    PlaceClusters(m_Batch, m_Frame, points, normals);
    for (SizeValueType n = 0; n < m_Batch.count; ++n)
    {
      m_Vertices[n].Set(points[n], normals[n]);
    }
    m_Batch.count = 0;
  }

private:
  const FCCFrame & m_Frame;
  FCCClusterBatch m_Batch{};
  Vertex m_Vertices[FCCClusterBatch::Capacity];
  TriangleSurface::PointType * m_Points;
  TriangleSurface::NormalType * m_Normals;
  std::uint8_t * m_AreOutside;
};

/** Places the vertices of one plane. */
class PlanePlacement
{
public:
  PlanePlacement(const FCCScalarField & scalars,
                 const FCCClusterPlane & plane,
                 SizeValueType k,
                 const FCCFieldPlanes & field,
                 Output & output)
    : m_Frame(scalars.frame)
    , m_EdgePoints(scalars, true, 1)
    , m_Plane(plane)
    , m_K(k)
    , m_Field(field)
    , m_Output(output)
  {}

  /** \param height number of rows of the plane */
  void
  PlaceWholeSites(SizeValueType height)
  {
    Row row(m_Field, m_Output.HasNormals());
    for (SizeValueType j = 0; j < height; ++j)
    {
      const bool isRealRow = m_Field.IsReal(1, j) && m_Field.IsReal(2, m_K);
      m_Plane.ForEachWholeSite(j, [&](SizeValueType i, unsigned int crossings) {
        if (isRealRow && m_Field.IsReal(0, i))
        {
          row.GoTo(j, m_K);
          m_Output.AddCluster(row, i, crossings);
        }
        else
        {
          this->PlaceOnBorder(m_EdgePoints.SiteOf(i, j, m_K), crossings);
        }
      });
    }
    m_Output.Flush();
  }

  void
  PlaceSplitSites()
  {
    // Points on edges are placed batch by batch, too, out of order.
    FCCEdgeBatch single{};
    Output::Vertex singleVertices[FCCEdgeBatch::Capacity];
    const auto placeSingle = [&] {
      TriangleSurface::PointType points[FCCEdgeBatch::Capacity];
      TriangleSurface::NormalType normals[FCCEdgeBatch::Capacity];
      const SizeValueType count = single.count;
      m_EdgePoints.PlaceBatch(single, points, m_Output.HasNormals() ? normals : nullptr);
      for (SizeValueType n = 0; n < count; ++n)
      {
        singleVertices[n].Set(points[n], normals[n]);
      }
    };
    Row row(m_Field, m_Output.HasNormals());
    for (const FCCClusterPlane::SplitSite & site : m_Plane.GetSplitSites())
    {
      const SizeValueType i = site.i;
      const SizeValueType j = site.j;
      const bool isReal = m_Field.IsReal(0, i) && m_Field.IsReal(1, j) && m_Field.IsReal(2, m_K);
      site.parts.ForEachVertex([&](unsigned int crossings) {
        const bool isSingle = (crossings & (crossings - 1)) == 0;
        if (isSingle)
        {
          const auto direction = static_cast<unsigned int>(__builtin_ctz(crossings));
          m_Output.Skip(singleVertices[single.count], !isReal);
          m_EdgePoints.Gather({ i, j, m_K }, FCCCells::StepOf(direction), m_Field, m_Output.HasNormals(), single);
          if (single.count == FCCEdgeBatch::Capacity)
          {
            placeSingle();
          }
        }
        else if (isReal)
        {
          row.GoTo(j, m_K);
          m_Output.AddCluster(row, i, crossings);
        }
        else
        {
          this->PlaceOnBorder(m_EdgePoints.SiteOf(i, j, m_K), crossings);
        }
      });
    }
    m_Output.Flush();
    placeSingle();
  }

private:
  void
  PlaceOnBorder(const SiteType & site, unsigned int crossings)
  {
    std::array<double, 3> sum{};
    double count = 0.0;
    for (; crossings != 0; crossings &= crossings - 1)
    {
      const SiteType step = FCCCells::StepOf(static_cast<unsigned int>(__builtin_ctz(crossings)));
      const SiteType end = FCCStep::Add(site, step);
      const double fraction = m_EdgePoints.GetExtent().FractionToBorder(end, FCCStep::Multiply(-1, step));
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        sum[axis] += static_cast<double>(end[axis]) - fraction * static_cast<double>(step[axis]);
      }
      count += 1.0;
    }
    TriangleSurface::PointType point;
    TriangleSurface::NormalType normal;
    const auto direction = m_EdgePoints.GetExtent().DirectionTo(site);
    double squared = 0.0;
    std::array<double, 3> outwards{};
    for (unsigned int row = 0; row < 3; ++row)
    {
      double world = m_Frame.origin[row];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        world += m_Frame.matrix[row][axis] * sum[axis] / count;
        outwards[row] += m_Frame.gradientToWorld[row][axis] * direction[axis];
      }
      point[row] = static_cast<float>(world);
      squared += outwards[row] * outwards[row];
    }
    for (unsigned int row = 0; row < 3; ++row)
    {
      normal[row] = static_cast<float>(outwards[row] / std::sqrt(squared));
    }
    m_Output.AddOutside(point, normal);
  }

  const FCCFrame & m_Frame;
  FCCEdgePoints m_EdgePoints;
  const FCCClusterPlane & m_Plane;
  SizeValueType m_K;
  const FCCFieldPlanes & m_Field;
  Output & m_Output;
};

} // namespace

void
PlaceVertices(const FCCScalarField & scalars,
              const FCCSigns & signs,
              const FCCClusterPlane & plane,
              SizeValueType k,
              const FCCFieldPlanes & field,
              TriangleSurface::PointType * points,
              TriangleSurface::NormalType * normals,
              std::uint8_t * areOutside)
{
  SiteType origin = FCCEdgePoints(scalars, true, 1).SiteOf(0, 0, k);
  origin[0] -= field.GetParity(0, k);
  Output output(scalars.frame, origin, points, normals, areOutside);
  PlanePlacement placement(scalars, plane, k, field, output);
  output.SetLimits(0.0f, FarthestOfWhole);
  placement.PlaceWholeSites(signs.GetHeight());
  output.SetLimits(static_cast<float>(scalars.minimumFraction), FarthestOfPart);
  placement.PlaceSplitSites();
}

} // namespace itk
