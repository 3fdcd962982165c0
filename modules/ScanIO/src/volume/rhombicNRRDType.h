#ifndef rhombicNRRDType_h
#define rhombicNRRDType_h

#include <string>

namespace rhombic
{

/** The name that Rhombic uses for a NRRD sample type: int8, uint8 and so on to uint64, float or double. \a name is any
 * of the names that the NRRD format has for the type, such as "signed short int", in upper or lower case. Empty for
 * other names, "block" among them. */
std::string
CanonicalNRRDType(const std::string & name);

} // namespace rhombic

#endif
