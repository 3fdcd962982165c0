#include "rhombicLabelTable.h"

#include "rhombicLabelTableFormats.h"
#include "rhombicFiles.h"
#include "rhombicWording.h"

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** How a file became a label table: by a user who named it, or by its own name. */
enum class TableChoice
{
  Named,
  Found
};

/** The labels of a text; nothing when it is no label table. A text that was found is none if it may as well be notes,
 * or the description of another data set. */
std::optional<LabelTable>
ParseIfLabelTable(std::string_view text, const std::string & source, TableChoice choice)
{
  if (text.size() > LongestLabelTable)
  {
    return std::nullopt;
  }
  text = WithoutByteOrderMark(text, source);
  const std::vector<TextLine> lines = LinesOfTable(text, source);
  const LabelTableFormat format = RecogniseLabelTable(text, lines, source);
  if (choice == TableChoice::Found && !IsSurelyLabelTable(format, text, lines))
  {
    return std::nullopt;
  }
  switch (format)
  {
    case LabelTableFormat::ITKSNAP:
      return ParseITKSNAPTable(lines, source);
    case LabelTableFormat::SlicerText:
      return ParseNamedTable(lines, source, false);
    case LabelTableFormat::FreeSurfer:
      return ParseNamedTable(lines, source, true);
    case LabelTableFormat::Columns:
      return ParseColumnTable(lines, source);
    case LabelTableFormat::ValueAndName:
      return ParseValuesAndNames(lines, source);
    case LabelTableFormat::DatasetJSON:
      return ParseDatasetJSON(text, source);
    case LabelTableFormat::SlicerProcedural:
      RefuseTable({ source }, "its colours are those of a scale, not of labels; choose a table of labels");
    case LabelTableFormat::None:
      break;
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
  for (const char * const sideCarExtension : { ".ctbl", ".csv", ".tsv", ".label", ".txt" })
  {
    const fs::path sideCar = volumePath.parent_path() / (StemOfVolume(volumePath) + sideCarExtension);
    if (fs::is_regular_file(sideCar))
    {
      if (auto table = ParseIfLabelTable(
            ReadTextFile(sideCar, "label table", LongestLabelTable), sideCar.string(), TableChoice::Found))
      {
        return table;
      }
    }
  }
  return std::nullopt;
}

std::optional<LabelTable>
FindDatasetTable(const fs::path & volumePath)
{
  const fs::path folder = fs::absolute(volumePath).parent_path();
  for (const fs::path & place : { folder, folder.parent_path() })
  {
    const fs::path dataset = place / "dataset.json";
    if (fs::is_regular_file(dataset))
    {
      if (auto table = ParseIfLabelTable(
            ReadTextFile(dataset, "label table", LongestLabelTable), dataset.string(), TableChoice::Found))
      {
        return table;
      }
    }
  }
  return std::nullopt;
}

} // namespace rhombic
