#ifndef rhombicAffineFile_h
#define rhombicAffineFile_h

#include "rhombicLabelOverlap.h"

#include <filesystem>

namespace rhombic
{

/** Reads one rigid or affine transform of 3-D points, as ITK writes it in text. Throws Failure: NotFound when there is
 * no file; Unreadable for other files, several transforms, and transforms that are not affine or cannot be inverted. */
AffineMap::Pointer
ReadAffineMap(const std::filesystem::path & path);

/** The inverse of an affine map, in its class. */
AffineMap::Pointer
InverseOf(const AffineMap & map);

} // namespace rhombic

#endif
