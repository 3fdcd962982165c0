#include "rhombicSidecar.h"

#include <fstream>

namespace rhombic
{

void
AddOutputs(const std::vector<std::filesystem::path> & paths,
           const std::string & kind,
           std::vector<MadeFile> & outputs,
           bool areMain)
{
  for (const std::filesystem::path & path : paths)
  {
    outputs.push_back({ path, kind, Report::array(), areMain });
  }
}

std::filesystem::path
SidecarOf(const std::filesystem::path & output)
{
  return output.string() + ".json";
}

std::vector<std::filesystem::path>
WithSidecars(std::vector<std::filesystem::path> outputs, const Provenance & provenance)
{
  const std::size_t count = provenance.writesSidecars ? outputs.size() : 0;
  for (std::size_t n = 0; n < count; ++n)
  {
    outputs.push_back(SidecarOf(outputs[n]));
  }
  return outputs;
}

void
AddOutput(const std::filesystem::path & path, const std::string & kind, const Report & report, OutputFiles & outputs)
{
  const Provenance & provenance = outputs.provenance;
  MadeFile & output = outputs.made.emplace_back(MadeFile{ path, kind });
  for (const Report & surface : report.value("surfaces", Report::array()))
  {
    output.measures.push_back(surface["measures"]);
  }
  if (provenance.writesSidecars)
  {
    Report sidecar{ { "output", path.filename().string() },
                    { "software", provenance.software },
                    { "command", provenance.command },
                    { "settings", provenance.settings } };
    sidecar.update(report);
    StageText(ToJson(sidecar) + '\n', SidecarOf(path), outputs.staged);
    AddOutputs({ SidecarOf(path) }, "report", outputs.made, false);
  }
}

void
StageText(const std::string & text,
          const std::filesystem::path & path,
          StagedFiles & staged,
          std::filesystem::perms permissions)
{
  AtomicFile & file = staged.Begin(path);
  if (permissions != std::filesystem::perms::unknown)
  {
    std::filesystem::permissions(file.GetTemporaryPath(), permissions); // before there is anything to read
  }
  std::ofstream(file.GetTemporaryPath(), std::ios::binary) << text;
  file.Flush(text.size());
}

} // namespace rhombic
