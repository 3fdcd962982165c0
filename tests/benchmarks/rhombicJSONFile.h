#ifndef rhombicJSONFile_h
#define rhombicJSONFile_h

#include <nlohmann/json.hpp>

#include <string>

namespace rhombic
{

/** Writes a report with an indentation of 2. Throws Failure(Output). */
void
WriteJSONFile(const std::string & path, const nlohmann::json & report);

} // namespace rhombic

#endif
