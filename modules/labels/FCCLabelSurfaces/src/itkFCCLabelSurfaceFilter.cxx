#include "itkFCCLabelSurfaceFilter.h"

#include "detail/itkForEachSlab.h"
#include "itkFCCLabelPlane.h"
#include "itkInputSamples.h"
#include "itkWorkProgress.h"

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
    for (unsigned int type = FCCCells::FirstTetrahedron; type < FCCCells::Types; ++type)
    {
      if (box.HasSimplices(j, plane.GetPlane(), type))
      {
        use(TetrahedraRow(plane, next, j, type), j, type);
      }
    }
  }
}

SizeValueType
CountTriangles(const FCCLabelPlane & plane, const FCCLabelPlane & next)
{
  SizeValueType count = 0;
  ForEachTetrahedraRow(plane, next, [&](const TetrahedraRow & row, SizeValueType, unsigned int) {
    row.ForEach([&](SizeValueType, const Cells::Case & found) { count += found.size; });
  });
  return count;
}

using Coordinates = std::array<double, 4>;

/** Solves the rows a x = b of \a size equations, each row being a and b, by elimination with pivots. Returns whether
 * there is one solution. */
bool
Solve(double (&rows)[4][5], unsigned int size, Coordinates & solution)
{
  constexpr double singular = 1e-9; // weights are float32 of the size of 1
  for (unsigned int column = 0; column < size; ++column)
  {
    unsigned int pivot = column;
    for (unsigned int row = column + 1; row < size; ++row)
    {
      pivot = std::abs(rows[row][column]) > std::abs(rows[pivot][column]) ? row : pivot;
    }
    if (!(std::abs(rows[pivot][column]) > singular))
    {
      return false;
    }
    std::swap(rows[pivot], rows[column]);
    for (unsigned int row = 0; row < size; ++row)
    {
      const double factor = row == column ? 0.0 : rows[row][column] / rows[column][column];
      for (unsigned int n = column; factor != 0.0 && n <= size; ++n)
      {
        rows[row][n] -= factor * rows[column][n];
      }
    }
  }
  for (unsigned int n = 0; n < size; ++n)
  {
    solution[n] = rows[n][size] / rows[n][n];
  }
  return true;
}

/** Barycentric coordinates of the point of a simplex where the weights of its sites' labels are equal. Where the
 * weights, which are linear, tie outside of the simplex, the point is moved towards the simplex's middle until each
 * coordinate is at least MinimumFraction. The middle if they tie nowhere.
 *
 * \param size sites of the simplex: 2, 3 or 4
 * \param weights by site and label: [site][n] is the weight at a site of the label of the n-th site */
Coordinates
FindTie(unsigned int size, const double (&weights)[4][4])
{
  constexpr double least = FCCLabelSurfaceFilter::MinimumFraction;
  const unsigned int last = size - 1;
  double rows[4][5] = {};
  for (unsigned int site = 0; site < size; ++site)
  {
    for (unsigned int label = 0; label < last; ++label)
    {
      rows[label][site] = weights[site][label] - weights[site][last];
    }
    rows[last][site] = 1.0;
  }
  rows[last][size] = 1.0;
  const double middle = 1.0 / size;
  Coordinates found{};
  Coordinates point{};
  if (!Solve(rows, size, found))
  {
    std::fill_n(point.begin(), size, middle);
    return point;
  }
  double scale = 1.0; // of the way from the middle
  for (unsigned int n = 0; n < size; ++n)
  {
    scale = found[n] < least ? std::min(scale, (middle - least) / (middle - found[n])) : scale;
  }
  for (unsigned int n = 0; n < size; ++n)
  {
    point[n] = middle + scale * (found[n] - middle);
  }
  return point;
}

/** The point of a simplex of some type at the site of an index. */
TriangleSurface::PointType
PlacePoint(const FCCLabelBox & box, const Index<3> & index, unsigned int type)
{
  const FCCCells::Simplex & simplex = FCCCells::Simplices[type];
  Index<3> sites[4];
  for (unsigned int n = 0; n < simplex.size; ++n)
  {
    sites[n] = box.Step(index, simplex.steps[n]);
  }
  double weights[4][4] = {};
  for (unsigned int n = 0; n < simplex.size; ++n)
  {
    const auto label = box.GetLabel(sites[n]);
    for (unsigned int site = 0; site < simplex.size; ++site)
    {
      weights[site][n] = box.GetWeight(sites[site], label);
    }
  }
  const Coordinates coordinates = FindTie(simplex.size, weights);
  PositionType steps{};
  for (unsigned int n = 0; n < simplex.size; ++n)
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

void
FillPoints(const FCCLabelPlane & plane, TriangleSurface::PointType * points)
{
  const FCCLabelBox & box = plane.GetBox();
  for (SizeValueType j = 0; j < box.GetHeight(); ++j)
  {
    for (unsigned int type = 0; type < FCCCells::Types; ++type)
    {
      FCCBits::ForEach(plane.GetRow(j, type).bits, box.GetNumberOfWords(), [&](SizeValueType i) {
        *points++ = PlacePoint(box, BoxIndex(i, j, plane.GetPlane()), type);
      });
    }
  }
}

void
FillTriangles(const FCCLabelPlane & plane,
              const FCCLabelPlane & next,
              bool isLeftHanded,
              TriangleSurface::TriangleType * triangles,
              LabelWalls::LabelPairType * pairs)
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
        *triangles++ = { row.GetNumber(triangle.corners[0], i), isTurned ? third : second, isTurned ? second : third };
        *pairs++ = { std::min(front, back), std::max(front, back) };
      }
    });
  });
}

/** Numbers of points and triangles, of a plane or before it. */
struct Counts
{
  SizeValueType points = 0;
  SizeValueType triangles = 0;
};

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
  WorkProgress progress(*this, 2 * box.GetDepth());
  const auto forEachPlane = [&](const auto & work) { // calls work(k, window of the planes from k on)
    ForEachSlab(*this, box.GetDepth(), 1, 64, [&](SizeValueType begin, SizeValueType end) {
      progress.CheckAbort();
      PlaneWindow window(box, begin);
      for (SizeValueType k = begin; k < end; ++k)
      {
        work(k, window);
        window.Advance();
      }
      progress.Completed(end - begin);
    });
  };
  std::vector<Counts> before(box.GetDepth() + 1); // first the counts of plane k at k + 1
  forEachPlane([&](SizeValueType k, PlaneWindow & window) {
    before[k + 1] = { window.Get(0).Count(), CountTriangles(window.Get(0), window.Get(1)) };
  });
  for (SizeValueType k = 0; k < box.GetDepth(); ++k)
  {
    before[k + 1].points += before[k].points;
    before[k + 1].triangles += before[k].triangles;
  }
  if (before.back().points > std::numeric_limits<std::uint32_t>::max())
  {
    itkExceptionMacro("The walls would have " << before.back().points
                                              << " points, more than 32-bit indices reach; use a coarser lattice.");
  }
  LabelWalls & walls = *this->GetOutput();
  walls.Initialize();
  walls.GetPoints().resize(before.back().points);
  walls.GetTriangles().resize(before.back().triangles);
  walls.GetTriangleLabels().resize(before.back().triangles);
  forEachPlane([&](SizeValueType k, PlaneWindow & window) {
    window.Get(0).Number(static_cast<std::uint32_t>(before[k].points));
    window.Get(1).Number(static_cast<std::uint32_t>(before[k + 1].points));
    FillPoints(window.Get(0), walls.GetPoints().data() + before[k].points);
    FillTriangles(window.Get(0),
                  window.Get(1),
                  isLeftHanded,
                  walls.GetTriangles().data() + before[k].triangles,
                  walls.GetTriangleLabels().data() + before[k].triangles);
  });
  progress.Finish();
}

} // namespace itk
