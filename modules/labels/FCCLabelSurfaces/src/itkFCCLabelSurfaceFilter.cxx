#include "itkFCCLabelSurfaceFilter.h"

#include "detail/itkForEachSlab.h"
#include "itkFCCLabelPlane.h"
#include "itkInputSamples.h"
#include "itkWorkProgress.h"
#include "rhombicForEachBlock.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace itk
{
namespace
{

using Cells = FCCLabelCells;
using WordType = FCCBits::WordType;

/** The planes around the plane that is worked at: labels and simplices of this plane and the next, and the edges of the
 * plane after that. */
class PlaneWindow
{
public:
  PlaneWindow(const FCCLabelBox & box, SizeValueType begin)
    : m_Box(box)
    , m_Labels{ FCCLabelBox::Plane(box, begin), FCCLabelBox::Plane(box, begin + 1) }
    , m_Planes{ FCCLabelPlane(box), FCCLabelPlane(box), FCCLabelPlane(box) }
  {
    m_Planes[0].FindEdges(begin, m_Labels[0], m_Labels[1]);
    this->FindEdgesOf(1, begin + 1);
    m_Planes[0].FindFacesAndTetrahedra(m_Planes[1]);
    this->FindEdgesOf(2, begin + 2);
    m_Planes[1].FindFacesAndTetrahedra(m_Planes[2]);
  }

  void
  Advance()
  {
    std::rotate(m_Order.begin(), m_Order.begin() + 1, m_Order.end());
    const SizeValueType k = this->Get(1).GetPlane();
    this->FindEdgesOf(m_Order[2], k + 1);
    m_Planes[m_Order[1]].FindFacesAndTetrahedra(m_Planes[m_Order[2]]);
  }

  /** This plane (0) or the next (1). */
  FCCLabelPlane &
  Get(unsigned int n)
  {
    return m_Planes[m_Order[n]];
  }

private:
  void
  FindEdgesOf(unsigned int plane, SizeValueType k)
  {
    m_Labels[0] = std::move(m_Labels[1]);
    m_Labels[1] = FCCLabelBox::Plane(m_Box, k + 1);
    m_Planes[plane].FindEdges(k, m_Labels[0], m_Labels[1]);
  }

  const FCCLabelBox & m_Box;
  std::array<FCCLabelBox::Plane, 2> m_Labels;
  std::array<FCCLabelPlane, 3> m_Planes;
  std::array<unsigned int, 3> m_Order{ { 0, 1, 2 } };
};

/** The tetrahedra of one type that a row stores, with the points of their parts. */
class TetrahedraRow
{
public:
  TetrahedraRow(const FCCLabelPlane & plane, const FCCLabelPlane & next, SizeValueType j, unsigned int type)
    : m_Words(plane.GetBox().GetNumberOfWords())
  {
    for (unsigned int set = 1; set < 16; ++set)
    {
      if (FCCCells::SizeOf(set) >= 2)
      {
        m_Parts[set] = plane.GetPart(next, j, type, set);
      }
    }
  }

  /** Calls use(i, found) for the tetrahedra that walls pass, in the case \a found. */
  template <typename TUse>
  void
  ForEach(const TUse & use) const
  {
    for (SizeValueType word = 0; word < m_Words; ++word)
    {
      WordType cut[6];
      WordType active = 0;
      for (unsigned int a = 0; a < 4; ++a)
      {
        for (unsigned int b = a + 1; b < 4; ++b)
        {
          const WordType bits = m_Parts[1u << a | 1u << b].GetBits(word);
          cut[Cells::EdgeBetween(a, b)] = bits;
          active |= bits;
        }
      }
      FCCBits::ForEach(active, word * FCCBits::WordBits, [&](SizeValueType i) {
        unsigned int pattern = 0;
        for (unsigned int edge = 0; edge < 6; ++edge)
        {
          pattern |= static_cast<unsigned int>(cut[edge] >> (i % FCCBits::WordBits) & 1) << edge;
        }
        use(i, FCCLabelCases[pattern]);
      });
    }
  }

  std::uint32_t
  GetNumber(unsigned int set, SizeValueType i) const
  {
    return m_Parts[set].GetNumber(i);
  }

private:
  SizeValueType m_Words;
  FCCLabelPart m_Parts[16]{}; ///< by the set of their sites, from two sites on
};

/** Calls use(row, j, type) for the rows of tetrahedra that a plane stores. */
template <typename TUse>
void
ForEachTetrahedraRow(const FCCLabelPlane & plane, const FCCLabelPlane & next, const TUse & use)
{
  const FCCLabelBox & box = plane.GetBox();
  for (SizeValueType j = 0; j < box.GetHeight(); ++j)
  {
    const bool mayHavePoints = plane.MayHavePoints(next, j);
    for (unsigned int type = FCCCells::FirstTetrahedron; type < FCCCells::Types; ++type)
    {
      if (mayHavePoints && box.HasSimplices(j, plane.GetPlane(), type))
      {
        use(TetrahedraRow(plane, next, j, type), j, type);
      }
    }
  }
}

constexpr double SingularPivot = 1e-9; // weights are float32 of the size of 1

/** Values of the sites of a simplex. */
template <typename TValue, std::size_t VSize>
using BySite = std::array<TValue, VSize>;

/** Solves the rows a x = b of equations, each row being a and b, by elimination with pivots. Returns whether there is
 * one solution. */
template <std::size_t VSize>
bool
Solve(std::array<std::array<double, VSize + 1>, VSize> & rows, BySite<double, VSize> & solution)
{
  for (std::size_t column = 0; column < VSize; ++column)
  {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < VSize; ++row)
    {
      pivot = std::abs(rows[row][column]) > std::abs(rows[pivot][column]) ? row : pivot;
    }
    if (!(std::abs(rows[pivot][column]) > SingularPivot))
    {
      return false;
    }
    std::swap(rows[pivot], rows[column]);
    for (std::size_t row = 0; row < VSize; ++row)
    {
      const double factor = row == column ? 0.0 : rows[row][column] / rows[column][column];
      for (std::size_t n = column; factor != 0.0 && n <= VSize; ++n)
      {
        rows[row][n] -= factor * rows[column][n];
      }
    }
  }
  for (std::size_t n = 0; n < VSize; ++n)
  {
    solution[n] = rows[n][VSize] / rows[n][n];
  }
  return true;
}

/** Barycentric coordinates of the point of a simplex where the weights of its sites' labels are equal. Where the
 * weights, which are linear, tie outside of the simplex or near its border, the point is moved towards the simplex's
 * middle until each coordinate is at least \a least. The middle if they tie nowhere.
 *
 * \param weights by site and label: [site][n] is the weight at a site of the label of the n-th site */
template <std::size_t VSize>
BySite<double, VSize>
FindTie(const BySite<BySite<double, VSize>, VSize> & weights, double least)
{
  if constexpr (VSize == 2) // most points
  {
    const double first = weights[0][0] - weights[0][1]; // the lead of the first label at the first site
    const double second = weights[1][0] - weights[1][1];
    const double share = std::abs(first - second) > SingularPivot ? first / (first - second) : 0.5; // of the second
    const double inEdge = std::clamp(share, least, 1.0 - least);
    return { 1.0 - inEdge, inEdge };
  }
  constexpr std::size_t last = VSize - 1;
  constexpr double middle = 1.0 / VSize;
  std::array<std::array<double, VSize + 1>, VSize> rows{};
  for (std::size_t site = 0; site < VSize; ++site)
  {
    for (std::size_t label = 0; label < last; ++label)
    {
      rows[label][site] = weights[site][label] - weights[site][last];
    }
    rows[last][site] = 1.0;
  }
  rows[last][VSize] = 1.0;
  BySite<double, VSize> found{};
  BySite<double, VSize> point;
  point.fill(middle);
  if (Solve<VSize>(rows, found))
  {
    double scale = 1.0; // of the way from the middle
    for (std::size_t n = 0; n < VSize; ++n)
    {
      scale = found[n] < least ? std::min(scale, (middle - least) / (middle - found[n])) : scale;
    }
    for (std::size_t n = 0; n < VSize; ++n)
    {
      point[n] = middle + scale * (found[n] - middle);
    }
  }
  return point;
}

/** The point of a simplex of VSize sites and of some type at the site of an index, see FindTie(). */
template <std::size_t VSize>
TriangleSurface::PointType
PlacePoint(const FCCLabelBox & box, const Index<3> & index, unsigned int type, double least)
{
  const FCCCells::Simplex & simplex = FCCCells::Simplices[type];
  BySite<Index<3>, VSize> sites;
  BySite<FCCLabelBox::LabelType, VSize> labels;
  for (std::size_t n = 0; n < VSize; ++n)
  {
    sites[n] = box.Step(index, simplex.steps[n]);
    labels[n] = box.GetLabel(sites[n]);
  }
  BySite<BySite<double, VSize>, VSize> weights;
  for (std::size_t n = 0; n < VSize; ++n)
  {
    box.GetWeights(sites[n], labels[n], labels, weights[n]);
  }
  const BySite<double, VSize> coordinates = FindTie<VSize>(weights, least);
  PositionType steps{};
  for (std::size_t n = 0; n < VSize; ++n)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      steps[axis] += coordinates[n] * static_cast<double>(simplex.steps[n][axis]);
    }
  }
  return box.GetPoint(index, steps);
}

Index<3>
BoxIndex(SizeValueType i, SizeValueType j, SizeValueType k)
{
  return { { static_cast<IndexValueType>(i), static_cast<IndexValueType>(j), static_cast<IndexValueType>(k) } };
}

/** The walls of some planes; points are numbered from the first of these planes. */
struct WallsOfSlab
{
  TriangleSurface::PointsContainer points;
  TriangleSurface::TrianglesContainer triangles;
  LabelWalls::LabelPairsContainer pairs;
};

/** Adds the points of the simplices of VSize sites, which are of some types, in a row. */
template <std::size_t VSize>
void
AddPointsOfRow(const FCCLabelPlane & plane,
               SizeValueType j,
               unsigned int beginType,
               unsigned int endType,
               double least,
               TriangleSurface::PointsContainer & points)
{
  const FCCLabelBox & box = plane.GetBox();
  for (unsigned int type = beginType; type < endType; ++type)
  {
    FCCBits::ForEach(plane.GetRow(j, type).bits, box.GetNumberOfWords(), [&](SizeValueType i) {
      points.push_back(PlacePoint<VSize>(box, BoxIndex(i, j, plane.GetPlane()), type, least));
    });
  }
}

void
AddPoints(const FCCLabelPlane & plane,
          const FCCLabelPlane & next,
          double junctionFraction,
          TriangleSurface::PointsContainer & points)
{
  constexpr double onEdges = FCCLabelSurfaceFilter::MinimumFraction;
  for (SizeValueType j = 0; j < plane.GetBox().GetHeight(); ++j)
  {
    if (plane.MayHavePoints(next, j))
    {
      AddPointsOfRow<2>(plane, j, 0, FCCCells::FirstFace, onEdges, points);
      AddPointsOfRow<3>(plane, j, FCCCells::FirstFace, FCCCells::FirstTetrahedron, junctionFraction, points);
      AddPointsOfRow<4>(plane, j, FCCCells::FirstTetrahedron, FCCCells::Types, junctionFraction, points);
    }
  }
}

void
AddTriangles(const FCCLabelPlane & plane, const FCCLabelPlane & next, bool isLeftHanded, WallsOfSlab & walls)
{
  const FCCLabelBox & box = plane.GetBox();
  ForEachTetrahedraRow(plane, next, [&](const TetrahedraRow & row, SizeValueType j, unsigned int type) {
    const FCCCells::Simplex & simplex = FCCCells::Simplices[type];
    row.ForEach([&](SizeValueType i, const Cells::Case & found) {
      LabelWalls::LabelType labels[4];
      for (unsigned int n = 0; n < 4; ++n)
      {
        labels[n] = box.GetLabel(box.Step(BoxIndex(i, j, plane.GetPlane()), simplex.steps[n]));
      }
      for (unsigned int n = 0; n < found.size; ++n)
      {
        const Cells::Triangle & triangle = found.triangles[n];
        const LabelWalls::LabelType front = labels[triangle.sides[0]];
        const LabelWalls::LabelType back = labels[triangle.sides[1]];
        const bool isTurned = (front > back) != (simplex.isPositive == isLeftHanded);
        const std::uint32_t second = row.GetNumber(triangle.corners[1], i);
        const std::uint32_t third = row.GetNumber(triangle.corners[2], i);
        walls.triangles.push_back(
          { row.GetNumber(triangle.corners[0], i), isTurned ? third : second, isTurned ? second : third });
        walls.pairs.push_back({ std::min(front, back), std::max(front, back) });
      }
    });
  });
}

/** Puts the walls of all slabs, in their order, together. */
void
JoinSlabs(const std::vector<WallsOfSlab> & slabs, LabelWalls & walls)
{
  std::vector<SizeValueType> points(slabs.size() + 1); // and triangles: before each slab, and of all
  std::vector<SizeValueType> triangles(slabs.size() + 1);
  for (std::size_t n = 0; n < slabs.size(); ++n)
  {
    points[n + 1] = points[n] + slabs[n].points.size();
    triangles[n + 1] = triangles[n] + slabs[n].triangles.size();
  }
  if (points.back() > std::numeric_limits<std::uint32_t>::max())
  {
    itkGenericExceptionMacro("The walls would have " << points.back() << " points, more than 32-bit indices reach; use "
                                                     << "a coarser lattice.");
  }
  walls.GetPoints().resize(points.back());
  walls.GetTriangles().resize(triangles.back());
  walls.GetTriangleLabels().resize(triangles.back());
  rhombic::ForEachOnThreads(slabs.size(), [&](std::size_t n) {
    std::copy(slabs[n].points.begin(), slabs[n].points.end(), walls.GetPoints().data() + points[n]);
    std::copy(slabs[n].pairs.begin(), slabs[n].pairs.end(), walls.GetTriangleLabels().data() + triangles[n]);
    const auto first = static_cast<std::uint32_t>(points[n]);
    const auto number = [first](const TriangleSurface::TriangleType & triangle) {
      return TriangleSurface::TriangleType{ triangle[0] + first, triangle[1] + first, triangle[2] + first };
    };
    std::transform(
      slabs[n].triangles.begin(), slabs[n].triangles.end(), walls.GetTriangles().data() + triangles[n], number);
  });
}

} // namespace

void
FCCLabelSurfaceFilter::GenerateData()
{
  const InputImageType & image = *this->GetInput();
  const auto & region = image.GetLargestPossibleRegion();
  VerifyInputSamples(*this, image, region);
  if (image.GetBufferedRegion() != region)
  {
    itkExceptionMacro("The input's buffer must be its largest possible region.");
  }
  const SizeValueType rows = region.GetSize(1) * region.GetSize(2);
  if (this->GetWeights() != nullptr && this->GetWeights()->GetNumberOfRows() != rows)
  {
    itkExceptionMacro("There are weights of " << this->GetWeights()->GetNumberOfRows() << " rows, but the image has "
                                              << rows << "; the weights must be those of the same image.");
  }
  const FCCLabelBox box(image, this->GetWeights());
  const bool isLeftHanded = vnl_determinant(image.GetDirection().GetVnlMatrix()) < 0.0;
  WorkProgress progress(*this, box.GetDepth());
  std::vector<WallsOfSlab> slabs(box.GetDepth()); // each at its first plane
  ForEachSlab(*this, box.GetDepth(), 1, 64, [&](SizeValueType begin, SizeValueType end) {
    PlaneWindow window(box, begin);
    WallsOfSlab walls;
    window.Get(0).Number(0);
    for (SizeValueType k = begin; k < end; ++k)
    {
      AddPoints(window.Get(0), window.Get(1), m_JunctionFraction, walls.points);
      window.Get(1).Number(static_cast<std::uint32_t>(walls.points.size()));
      AddTriangles(window.Get(0), window.Get(1), isLeftHanded, walls);
      window.Advance();
    }
    slabs[begin] = std::move(walls);
    progress.Completed(end - begin);
  });
  this->GetOutput()->Initialize();
  JoinSlabs(slabs, *this->GetOutput());
  progress.Finish();
}

} // namespace itk
