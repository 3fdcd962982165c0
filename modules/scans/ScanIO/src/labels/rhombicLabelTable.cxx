#include "rhombicLabelTable.h"

#include "rhombicLabelTableFormats.h"
#include "rhombicFiles.h"
#include "rhombicWording.h"

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** The label table in the first of the files that is one. */
std::optional<LabelTable>
FindAmong(const std::vector<fs::path> & files)
{
  for (const fs::path & file : files)
  {
    std::error_code error;
    if (fs::is_regular_file(file, error))
    {
      const std::string text = ReadTextFile(file, "label table", LongestLabelTable);
      if (auto table = ParseIfLabelTable(text, file.string(), TableChoice::Found))
      {
        return table;
      }
    }
  }
  return std::nullopt;
}

} // namespace

std::string
StemOfVolume(const fs::path & volumePath)
{
  std::string name = volumePath.filename().string();
  for (const std::string extension : { ".gz", ".nii", ".hdr", ".img", ".nrrd", ".nhdr", ".seg", ".mha", ".mhd" })
  {
    const bool isThere =
      name.size() > extension.size() && LowerCase(name.substr(name.size() - extension.size())) == extension;
    name.resize(name.size() - (isThere ? extension.size() : 0));
  }
  return name;
}

LabelTable
ParseLabelTable(std::string_view text, const std::string & source)
{
  if (text.size() > LongestLabelTable)
  {
    RefuseTable({ source }, "it is longer than 1 MiB, too long for a label table; check that it is one");
  }
  if (auto table = ParseIfLabelTable(text, source, TableChoice::Named))
  {
    return *std::move(table);
  }
  RefuseTable(
    { source },
    "it is no label table of ITK-SNAP, 3D Slicer, FreeSurfer, BIDS or nnU-Net, and has no columns of values and "
    "names; save the labels as one of these");
}

LabelTable
ReadLabelTable(const fs::path & path)
{
  return ParseLabelTable(ReadTextFile(path, "label table", LongestLabelTable), path.string());
}

std::optional<LabelTable>
FindLabelTable(const fs::path & volumePath)
{
  const fs::path extension = volumePath.extension() == ".gz" ? volumePath.stem().extension() : volumePath.extension();
  if (extension == ".nii" || volumePath.extension() == ".hdr")
  {
    if (auto table = ReadNIfTILabelTable(volumePath))
    {
      return table;
    }
  }
  std::vector<fs::path> sideCars;
  for (const char * const sideCarExtension : { ".ctbl", ".csv", ".tsv", ".label", ".txt" })
  {
    sideCars.push_back(volumePath.parent_path() / (StemOfVolume(volumePath) + sideCarExtension));
  }
  return FindAmong(sideCars);
}

std::optional<LabelTable>
FindDatasetTable(const fs::path & volumePath)
{
  const fs::path folder = fs::absolute(volumePath).parent_path();
  return FindAmong({ folder / "dataset.json", folder.parent_path() / "dataset.json" });
}

} // namespace rhombic
