#ifndef itkSingleSheets_h
#define itkSingleSheets_h

#include "detail/itkTriangleCells.h"

namespace itk
{

/** The triangles of a closed surface that are not proved to cross no others, in any order: all pairs that cross are
 * among them. Nothing if most are, as on noise, or if the surface is not closed.
 *
 * The proof is that lines along an axis cross the surface at most once near there. Linear time, a fifth of that of a
 * search for crossings. */
std::optional<BulkVector<std::uint32_t>>
FindTrianglesOutsideSingleSheets(const TriangleSurface & surface, const TriangleSizes & sizes);

} // namespace itk

#endif
