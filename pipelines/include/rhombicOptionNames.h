#ifndef rhombicOptionNames_h
#define rhombicOptionNames_h

#include <string>

namespace rhombic
{

/** A module's sentence with the program's options in place of the settings that the module names: "choose one with
 * --series" for "choose one with ScanReadOptions::series". Modules know no options, which users of ITK do not have.
 * Thread safe. */
std::string
NameOptions(std::string sentence);

} // namespace rhombic

#endif
