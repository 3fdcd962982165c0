#include "rhombicJSONFile.h"

#include "rhombicFailure.h"

#include <fstream>

namespace rhombic
{

void
WriteJSONFile(const std::string & path, const nlohmann::json & report)
{
  std::ofstream file(path);
  file << report.dump(2) << '\n' << std::flush;
  if (!file)
  {
    throw Failure(FailureKind::Output, "Cannot write " + path + "; is there a folder for it, and space?");
  }
}

} // namespace rhombic
