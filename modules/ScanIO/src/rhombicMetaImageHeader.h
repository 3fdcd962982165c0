#ifndef rhombicMetaImageHeader_h
#define rhombicMetaImageHeader_h

#include <filesystem>

namespace rhombic
{

/** Throws Failure(Unreadable) when the pixels that a MetaImage header announces are missing or cut off. Headers it
 * can't judge (compressed pixels, lists of files) pass: MetaIO finds out. */
void
CheckMetaImageData(const std::filesystem::path & path);

} // namespace rhombic

#endif
