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

constexpr std::size_t BlockSize = 4096;

bool
AreDuplicates(TriangleType a, TriangleType b)
{
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

/** Which triangles are tested: every \a stride-th of the tree's order. */
std::vector<bool>
SelectTested(const TriangleTree & tree, std::size_t stride)
{
  std::vector<bool> isTested(tree.GetSurface().GetNumberOfTriangles(), false);
  for (std::size_t place = 0; place < tree.GetOrder().size(); place += stride)
  {
    isTested[tree.GetOrder()[place]] = true;
  }
  return isTested;
}

/** The contacts of one triangle, leaving those to others that are tested too and have a lower number. */
void
CountContacts(const TriangleTree & tree,
              const std::vector<bool> & isTested,
              std::uint32_t triangle,
              TriangleSurfaceIntersections & counts)
{
  const auto & triangles = tree.GetSurface().GetTriangles();
  tree.VisitTriangles(tree.GetTriangleBox(triangle), [&](std::uint32_t other) {
    if (other == triangle || (other < triangle && isTested[other]))
    {
      return;
    }
    const Contact contact = FindContact(tree.GetSurface().GetPoints(), triangles[triangle], triangles[other]);
    if (contact == Contact::Touching)
    {
      ++counts.touchingPairs;
    }
    else if (contact == Contact::Crossing && !AreDuplicates(triangles[triangle], triangles[other]))
    {
      ++counts.crossingPairs;
    }
  });
}

} // namespace

TriangleSurfaceIntersections
FindSelfIntersections(const TriangleTree & tree, SizeValueType maximumTestedTriangles)
{
  const auto & order = tree.GetOrder();
  const SizeValueType most = std::max<SizeValueType>(1, maximumTestedTriangles);
  const std::size_t stride = std::max<std::size_t>(1, (order.size() + most - 1) / most);
  const std::vector<bool> isTested = SelectTested(tree, stride);

  TriangleSurfaceIntersections found;
  std::mutex mutex;
  ForEachBlock(order.size(), BlockSize, [&](std::size_t begin, std::size_t end) {
    TriangleSurfaceIntersections ofBlock;
    for (std::size_t place = (begin + stride - 1) / stride * stride; place < end; place += stride)
    {
      CountContacts(tree, isTested, order[place], ofBlock);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    found.crossingPairs += ofBlock.crossingPairs;
    found.touchingPairs += ofBlock.touchingPairs;
  });
  const SizeValueType unplaced = tree.GetSurface().GetNumberOfTriangles() - order.size();
  found.testedTriangles = (order.size() + stride - 1) / stride + unplaced;
  found.isSampled = stride > 1;
  return found;
}

} // namespace itk
