#include "itkTriangleSurfaceIntersections.h"

#include "itkForEachBlock.h"
#include "itkTriangleContact.h"

#include <mutex>

namespace itk
{
namespace
{

using Contact = TriangleContactEnums::Contact;
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

void
CountContact(const TriangleSurface & surface, std::uint32_t a, std::uint32_t b, TriangleSurfaceIntersections & counts)
{
  const TriangleType & first = surface.GetTriangles()[a];
  const TriangleType & second = surface.GetTriangles()[b];
  const Contact contact = FindContact(surface.GetPoints(), first, second);
  if (contact == Contact::Touching)
  {
    ++counts.touchingPairs;
  }
  else if (contact == Contact::Crossing && !AreDuplicates(first, second))
  {
    ++counts.crossingPairs;
  }
}

/** Counts the contacts of the triangles of two leaves, or of one with itself. */
void
CountContacts(const TriangleTree & tree,
              const Boxes & boxes,
              std::size_t tested,
              std::size_t other,
              TriangleSurfaceIntersections & counts)
{
  const TriangleTree::Leaf first = tree.GetLeaf(tested);
  const TriangleTree::Leaf second = tree.GetLeaf(other);
  for (std::size_t m = 0; m < second.size(); ++m)
  {
    const TriangleTree::Box box = tree.GetTriangleBox(second.begin()[m]);
    for (std::size_t n = 0; n < (other == tested ? m : first.size()); ++n)
    {
      if (boxes[n].Overlaps(box))
      {
        CountContact(tree.GetSurface(), first.begin()[n], second.begin()[m], counts);
      }
    }
  }
}

/** Counts the contacts of the triangles of one leaf, every \a stride-th being tested, but for those that an earlier
 * leaf has found. */
void
TestLeaf(const TriangleTree & tree, std::size_t leaf, std::size_t stride, TriangleSurfaceIntersections & counts)
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
      CountContacts(tree, boxes, leaf, other, counts);
    }
  });
  counts.testedTriangles += tree.GetLeaf(leaf).size();
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
    for (std::size_t leaf = (begin + stride - 1) / stride * stride; leaf < end; leaf += stride)
    {
      TestLeaf(tree, leaf, stride, ofBlock);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    found.crossingPairs += ofBlock.crossingPairs;
    found.touchingPairs += ofBlock.touchingPairs;
    found.testedTriangles += ofBlock.testedTriangles;
  });
  return found;
}

} // namespace itk
