#include "itkTriangleSurfaceIntersections.h"

#include "detail/itkTriangleContact.h"
#include "itkForEachBlock.h"

#include <algorithm>
#include <mutex>

namespace itk
{
namespace
{

using Contact = TriangleContact;
using TriangleType = TriangleSurface::TriangleType;

using Boxes = std::array<TriangleTree::Box, TriangleTree::LeafSize>;

constexpr std::size_t BlockOfLeaves = 1024;

bool
AreDuplicates(TriangleType a, TriangleType b)
{
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

/** Calls \a visit(a, b, contact) for the pairs of triangles of two leaves, or of one leaf, whose boxes overlap. */
template <typename TVisitor>
void
VisitContacts(const TriangleTree & tree,
              const Boxes & boxes,
              std::size_t tested,
              std::size_t other,
              const TVisitor & visit)
{
  const auto & points = tree.GetSurface().GetPoints();
  const auto & triangles = tree.GetSurface().GetTriangles();
  const TriangleTree::Leaf first = tree.GetLeaf(tested);
  const TriangleTree::Leaf second = tree.GetLeaf(other);
  for (std::size_t m = 0; m < second.size(); ++m)
  {
    const std::uint32_t b = second.begin()[m];
    const TriangleTree::Box box = tree.GetTriangleBox(b);
    for (std::size_t n = 0; n < (other == tested ? m : first.size()); ++n)
    {
      if (boxes[n].Overlaps(box))
      {
        const std::uint32_t a = first.begin()[n];
        visit(a, b, FindContact(points, triangles[a], triangles[b]));
      }
    }
  }
}

/** Calls \a visit(a, b, contact) for the triangles of one leaf, without pairs that an earlier leaf has visited. Every
 * \a stride-th leaf is tested. */
template <typename TVisitor>
void
TestLeaf(const TriangleTree & tree, std::size_t leaf, std::size_t stride, const TVisitor & visit)
{
  Boxes boxes;
  TriangleTree::Box around = tree.GetTriangleBox(*tree.GetLeaf(leaf).begin());
  auto box = boxes.begin();
  for (const std::uint32_t triangle : tree.GetLeaf(leaf))
  {
    *box = tree.GetTriangleBox(triangle);
    around = TriangleTree::Union(around, *box++);
  }
  tree.VisitLeaves(around, stride == 1 ? leaf : 0, [&](std::size_t other) {
    const bool isDone = other < leaf && other % stride == 0;
    if (!isDone)
    {
      VisitContacts(tree, boxes, leaf, other, visit);
    }
  });
}

} // namespace

TriangleSurfaceIntersections
FindSelfIntersections(const TriangleTree & tree, SizeValueType maximumTestedTriangles)
{
  const SizeValueType placed = tree.GetNumberOfPlacedTriangles();
  const SizeValueType most = std::max<SizeValueType>(TriangleTree::LeafSize, maximumTestedTriangles);
  const std::size_t stride = std::max<std::size_t>(1, (placed + most - 1) / most);

  TriangleSurfaceIntersections found;
  found.testedTriangles = tree.GetSurface().GetNumberOfTriangles() - placed;
  found.isSampled = stride > 1;
  std::mutex mutex;
  ForEachBlock(tree.GetNumberOfLeaves(), BlockOfLeaves, [&](std::size_t begin, std::size_t end) {
    TriangleSurfaceIntersections ofBlock;
    const auto count = [&](std::uint32_t a, std::uint32_t b, Contact contact) {
      const auto & triangles = tree.GetSurface().GetTriangles();
      ofBlock.touchingPairs += contact == Contact::Touching ? 1 : 0;
      ofBlock.crossingPairs += contact == Contact::Crossing && !AreDuplicates(triangles[a], triangles[b]) ? 1 : 0;
    };
    for (std::size_t leaf = (begin + stride - 1) / stride * stride; leaf < end; leaf += stride)
    {
      TestLeaf(tree, leaf, stride, count);
      ofBlock.testedTriangles += tree.GetLeaf(leaf).size();
    }
    const std::lock_guard<std::mutex> lock(mutex);
    found.crossingPairs += ofBlock.crossingPairs;
    found.touchingPairs += ofBlock.touchingPairs;
    found.testedTriangles += ofBlock.testedTriangles;
  });
  return found;
}

std::vector<std::uint32_t>
FindCrossingTriangles(const TriangleTree & tree)
{
  std::vector<std::uint32_t> found;
  std::mutex mutex;
  ForEachBlock(tree.GetNumberOfLeaves(), BlockOfLeaves, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> ofBlock;
    for (std::size_t leaf = begin; leaf < end; ++leaf)
    {
      TestLeaf(tree, leaf, 1, [&](std::uint32_t a, std::uint32_t b, Contact contact) {
        if (contact == Contact::Crossing)
        {
          ofBlock.insert(ofBlock.end(), { a, b });
        }
      });
    }
    const std::lock_guard<std::mutex> lock(mutex);
    found.insert(found.end(), ofBlock.begin(), ofBlock.end());
  });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

} // namespace itk
