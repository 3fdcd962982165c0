#ifndef itkTriangleSurfaceComponents_h
#define itkTriangleSurfaceComponents_h

#include "itkTriangleSurface.h"

#include <limits>

namespace itk
{

/** \class TriangleSurfaceComponents
 * \brief Which connected component each point of a surface belongs to.
 *
 * Thread safety: a value. */
struct TriangleSurfaceComponents
{
  /** Component of a point of no triangle. */
  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t count = 0;
  std::vector<std::uint32_t> ofPoint; ///< 0 to count - 1 in the order of each component's first point, or None
};

/** Sets of triangles connected through shared points. Nearly linear in time; 4 bytes a point, twice that while it
 * runs. Thread safe. */
TriangleSurfaceComponents
FindComponents(const TriangleSurface & surface);

/** The first point of each component. Thread safe. */
std::vector<std::uint32_t>
FindFirstPoints(const TriangleSurfaceComponents & components);

/** Removes the triangles of the components for which \a keep is false, and their points. Thread safe for
 * different surfaces. */
void
KeepComponents(TriangleSurface & surface, const TriangleSurfaceComponents & components, const std::vector<bool> & keep);

} // namespace itk

#endif
