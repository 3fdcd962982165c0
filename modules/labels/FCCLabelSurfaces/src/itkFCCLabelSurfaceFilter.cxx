#include "itkFCCLabelSurfaceFilter.h"

#include "detail/itkForEachSlab.h"
#include "itkFCCLabelPlane.h"
#include "itkFCCLabelTie.h"
#include "itkInputSamples.h"
#include "itkWorkProgress.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>

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
  TetrahedraRow(const FCCLabelBox & box,
                const FCCLabelPlane & plane,
                const FCCLabelPlane & next,
                SizeValueType j,
                unsigned int type)
  {
    for (unsigned int set = 1; set < 16; ++set)
    {
      if (FCCCells::SizeOf(set) >= 2)
      {
        m_Parts[set].emplace(box, plane, next, j, type, set);
      }
    }
  }

  /** Calls use(i, found) for the tetrahedra that walls pass, in the case \a found. */
  template <typename TUse>
  void
  ForEach(SizeValueType words, const TUse & use) const
  {
    for (SizeValueType word = 0; word < words; ++word)
    {
      WordType cut[6];
      WordType active = 0;
      for (unsigned int a = 0; a < 4; ++a)
      {
        for (unsigned int b = a + 1; b < 4; ++b)
        {
          const WordType bits = m_Parts[1u << a | 1u << b]->GetBits(word);
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
    return m_Parts[set]->GetNumber(i);
  }

private:
  std::optional<FCCLabelPart> m_Parts[16];
};

/** Calls use(row, j, type) for the rows of tetrahedra that a plane stores. */
template <typename TUse>
void
ForEachTetrahedraRow(const FCCLabelBox & box, const FCCLabelPlane & plane, const FCCLabelPlane & next, const TUse & use)
{
  for (SizeValueType j = 0; j < box.GetHeight(); ++j)
  {
    for (unsigned int type = FCCCells::FirstTetrahedron; type < FCCCells::Types; ++type)
    {
      if (box.HasSimplices(j, plane.GetPlane(), type))
      {
        use(TetrahedraRow(box, plane, next, j, type), j, type);
      }
    }
  }
}

SizeValueType
CountTriangles(const FCCLabelBox & box, const FCCLabelPlane & plane, const FCCLabelPlane & next)
{
  SizeValueType count = 0;
  ForEachTetrahedraRow(box, plane, next, [&](const TetrahedraRow & row, SizeValueType, unsigned int) {
    row.ForEach(box.GetNumberOfWords(), [&](SizeValueType, const Cells::Case & found) { count += found.size; });
  });
  return count;
}

/** Labels and weights at sites of the box. */
class SiteReader
{
public:
  SiteReader(const FCCLabelBox & box,
             const FCCLabelSurfaceFilter::InputImageType & image,
             const FCCLabelWeights * weights)
    : m_Box(box)
    , m_Image(image)
    , m_Weights(weights)
  {}

  FCCLabelBox::LabelType
  GetLabel(const Index<3> & site) const
  {
    SizeValueType row = 0;
    return this->FindRow(site, row)
             ? m_Image.GetBufferPointer()[row * this->GetWidth() + static_cast<SizeValueType>(site[0] - 1)]
             : 0;
  }

  double
  GetWeight(const Index<3> & site, FCCLabelBox::LabelType label) const
  {
    SizeValueType row = 0;
    const float * const weight = m_Weights != nullptr && this->FindRow(site, row)
                                   ? m_Weights->Find(row, static_cast<std::uint32_t>(site[0] - 1), label)
                                   : nullptr;
    const auto limit = static_cast<double>(FCCLabelWeights::Limit);
    return weight != nullptr ? static_cast<double>(*weight) : this->GetLabel(site) == label ? limit : -limit;
  }

private:
  SizeValueType
  GetWidth() const
  {
    return m_Box.GetWidth() - 2;
  }

  bool
  FindRow(const Index<3> & site, SizeValueType & row) const
  {
    return site[0] >= 1 && static_cast<SizeValueType>(site[0]) <= this->GetWidth() &&
           m_Box.FindImageRow(static_cast<SizeValueType>(site[1]), static_cast<SizeValueType>(site[2]), row);
  }

  const FCCLabelBox & m_Box;
  const FCCLabelSurfaceFilter::InputImageType & m_Image;
  const FCCLabelWeights * m_Weights;
};

/** Where the indices of the box lie in the world. */
class BoxFrame
{
public:
  BoxFrame(const FCCLabelBox & box, const FCCLabelSurfaceFilter::InputImageType & image)
    : m_Box(box)
    , m_Image(image)
    , m_First(image.GetLargestPossibleRegion().GetIndex())
  {}

  /** The index in the box of the site at a step from the site at an index. */
  Index<3>
  Step(const Index<3> & from, const FCCLattice::SiteType & step) const
  {
    return from + FCCLattice::OffsetOf(
                    step, m_Box.GetParity(static_cast<SizeValueType>(from[1]), static_cast<SizeValueType>(from[2])));
  }

  /** The point at some lattice steps from the site at an index of the box. */
  TriangleSurface::PointType
  GetPoint(const Index<3> & index, const std::array<double, 3> & steps) const
  {
    const Index<3> inImage{ { m_First[0] + index[0] - 1, m_First[1] + index[1] - 1, m_First[2] + index[2] - 1 } };
    const FCCLattice::SiteType site = FCCLattice::SiteOf(inImage);
    const auto point = m_Image.TransformLatticeToPhysicalPoint<double>({ static_cast<double>(site[0]) + steps[0],
                                                                         static_cast<double>(site[1]) + steps[1],
                                                                         static_cast<double>(site[2]) + steps[2] });
    return { static_cast<float>(point[0]), static_cast<float>(point[1]), static_cast<float>(point[2]) };
  }

  bool
  IsLeftHanded() const
  {
    return vnl_determinant(m_Image.GetDirection().GetVnlMatrix()) < 0.0;
  }

private:
  const FCCLabelBox & m_Box;
  const FCCLabelSurfaceFilter::InputImageType & m_Image;
  Index<3> m_First;
};

/** The point of a simplex of some type at the site of an index. */
TriangleSurface::PointType
PlacePoint(const SiteReader & reader, const BoxFrame & frame, const Index<3> & index, unsigned int type)
{
  const FCCCells::Simplex & simplex = FCCCells::Simplices[type];
  Index<3> sites[4];
  for (unsigned int n = 0; n < simplex.size; ++n)
  {
    sites[n] = frame.Step(index, simplex.steps[n]);
  }
  double weights[4][4] = {};
  for (unsigned int n = 0; n < simplex.size; ++n)
  {
    const auto label = reader.GetLabel(sites[n]);
    for (unsigned int site = 0; site < simplex.size; ++site)
    {
      weights[site][n] = reader.GetWeight(sites[site], label);
    }
  }
  const auto coordinates = FindFCCLabelTie(simplex.size, weights, FCCLabelSurfaceFilter::MinimumFraction);
  std::array<double, 3> steps{};
  for (unsigned int n = 0; n < simplex.size; ++n)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      steps[axis] += coordinates[n] * static_cast<double>(simplex.steps[n][axis]);
    }
  }
  return frame.GetPoint(index, steps);
}

Index<3>
BoxIndex(SizeValueType i, SizeValueType j, SizeValueType k)
{
  return { { static_cast<IndexValueType>(i), static_cast<IndexValueType>(j), static_cast<IndexValueType>(k) } };
}

void
FillPoints(const FCCLabelBox & box,
           const FCCLabelPlane & plane,
           const SiteReader & reader,
           const BoxFrame & frame,
           TriangleSurface::PointType * points)
{
  for (SizeValueType j = 0; j < box.GetHeight(); ++j)
  {
    for (unsigned int type = 0; type < FCCCells::Types; ++type)
    {
      FCCBits::ForEach(plane.GetRow(j, type).bits, box.GetNumberOfWords(), [&](SizeValueType i) {
        *points++ = PlacePoint(reader, frame, BoxIndex(i, j, plane.GetPlane()), type);
      });
    }
  }
}

void
FillTriangles(const FCCLabelBox & box,
              const FCCLabelPlane & plane,
              const FCCLabelPlane & next,
              const SiteReader & reader,
              const BoxFrame & frame,
              TriangleSurface::TriangleType * triangles,
              LabelWalls::LabelPairType * pairs)
{
  const bool isLeftHanded = frame.IsLeftHanded();
  ForEachTetrahedraRow(box, plane, next, [&](const TetrahedraRow & row, SizeValueType j, unsigned int type) {
    const FCCCells::Simplex & simplex = FCCCells::Simplices[type];
    row.ForEach(box.GetNumberOfWords(), [&](SizeValueType i, const Cells::Case & found) {
      LabelWalls::LabelType labels[4];
      for (unsigned int n = 0; n < 4; ++n)
      {
        labels[n] = reader.GetLabel(frame.Step(BoxIndex(i, j, plane.GetPlane()), simplex.steps[n]));
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

} // namespace

void
FCCLabelSurfaceFilter::Fill(const FCCLabelBox & box,
                            SizeValueType begin,
                            SizeValueType end,
                            const std::vector<Counts> & before)
{
  const SiteReader reader(box, *this->GetInput(), this->GetWeights());
  const BoxFrame frame(box, *this->GetInput());
  LabelWalls & walls = *this->GetOutput();
  PlaneWindow window(box, begin);
  for (SizeValueType k = begin; k < end; ++k)
  {
    window.Get(0).Number(static_cast<std::uint32_t>(before[k].points));
    window.Get(1).Number(static_cast<std::uint32_t>(before[k + 1].points));
    FillPoints(box, window.Get(0), reader, frame, walls.GetPoints().data() + before[k].points);
    FillTriangles(box,
                  window.Get(0),
                  window.Get(1),
                  reader,
                  frame,
                  walls.GetTriangles().data() + before[k].triangles,
                  walls.GetTriangleLabels().data() + before[k].triangles);
    window.Advance();
  }
}

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
  const FCCLabelBox box(image.GetBufferPointer(),
                        { region.GetSize(0), region.GetSize(1), region.GetSize(2) },
                        FCCLattice::Parity(region.GetIndex(1), region.GetIndex(2)));
  WorkProgress progress(*this, 2 * box.GetDepth());
  const auto forEachSlab = [&](const auto & work) {
    ForEachSlab(*this, box.GetDepth(), 1, 64, [&](SizeValueType begin, SizeValueType end) {
      progress.CheckAbort();
      work(begin, end);
      progress.Completed(end - begin);
    });
  };
  std::vector<Counts> before(box.GetDepth() + 1); // first the counts of plane k at k + 1
  forEachSlab([&](SizeValueType begin, SizeValueType end) {
    PlaneWindow window(box, begin);
    for (SizeValueType k = begin; k < end; ++k)
    {
      before[k + 1] = { window.Get(0).Count(), CountTriangles(box, window.Get(0), window.Get(1)) };
      window.Advance();
    }
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
  forEachSlab([&](SizeValueType begin, SizeValueType end) { this->Fill(box, begin, end, before); });
  progress.Finish();
}

} // namespace itk
