#ifndef rhombicLoadLibrary_h
#define rhombicLoadLibrary_h

namespace rhombic
{

/** A function of a library in lib/rhombic that comes with this program. The library stays loaded. Throws
 * Failure(Internal) with \a purpose, as "reads and writes pictures", if there is no such library or function.
 * Thread safe. */
void *
FindInLibrary(const char * library, const char * function, const char * purpose);

} // namespace rhombic

#endif
