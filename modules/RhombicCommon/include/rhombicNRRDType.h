#ifndef rhombicNRRDType_h
#define rhombicNRRDType_h

#include <string>

namespace rhombic
{

/** The one name that Rhombic has for a type of samples: int8, uint8 and so on to uint64, float or double. \a name is
 * any of those that the NRRD format has for it, such as "signed short int", in upper or lower case. Empty for other
 * names, "block" among them. Thread safe. */
std::string
CanonicalNRRDType(const std::string & name);

} // namespace rhombic

#endif
