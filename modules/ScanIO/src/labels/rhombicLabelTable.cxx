#include "rhombicLabelTable.h"

#include "rhombicFailure.h"
#include "rhombicLabelTableFormats.h"
#include "rhombicWording.h"

#include <fstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** A file of at most LongestLabelTable bytes; one byte more of longer files. */
std::string
ReadText(const fs::path & path)
{
  if (!fs::exists(path))
  {
    throw Failure(FailureKind::NotFound, "There is no label table " + path.string() + "; check the path.");
  }
  std::ifstream file;
  if (fs::is_regular_file(path)) // opening a pipe would wait for its other end
  {
    file.open(path, std::ios::binary);
  }
  if (!file.is_open())
  {
    RefuseTable({ path.string() }, "it is no file, or not yours to read; name a file of labels");
  }
  std::string text(LongestLabelTable + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

/** The labels of a text; nothing when it is no label table. */
std::optional<LabelTable>
ParseIfLabelTable(std::string_view text, const std::string & source)
{
  if (text.size() > LongestLabelTable)
  {
    return std::nullopt;
  }
  const std::vector<TextLine> lines = LinesOfTable(text, source);
  switch (RecogniseLabelTable(text, lines, source))
  {
    case LabelTableFormat::ITKSNAP:
      return ParseITKSNAPTable(lines, source);
    case LabelTableFormat::SlicerText:
      return ParseSlicerTable(lines, source);
    case LabelTableFormat::SlicerCSV:
      return ParseSlicerCSV(lines, source);
    case LabelTableFormat::FreeSurfer:
      return ParseFreeSurferTable(lines, source);
    case LabelTableFormat::BIDS:
      return ParseBIDSTable(lines, source);
    case LabelTableFormat::SlicerProcedural:
      RefuseTable({ source }, "its colours are those of a scale, not of labels; choose a table of labels");
    case LabelTableFormat::None:
      break;
  }
  return std::nullopt;
}

/** The name of a label map without the extensions of volumes. */
std::string
StemOf(const fs::path & volumePath)
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

} // namespace

LabelTable
ParseLabelTable(std::string_view text, const std::string & source)
{
  if (text.size() > LongestLabelTable)
  {
    RefuseTable({ source }, "it is longer than 1 MiB, too long for a label table; check that it is one");
  }
  if (auto table = ParseIfLabelTable(text, source))
  {
    return *std::move(table);
  }
  RefuseTable({ source },
              "it is no label table of ITK-SNAP, 3D Slicer, FreeSurfer or BIDS; save the labels as one of these");
}

LabelTable
ReadLabelTable(const fs::path & path)
{
  return ParseLabelTable(ReadText(path), path.string());
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
    const fs::path sideCar = volumePath.parent_path() / (StemOf(volumePath) + sideCarExtension);
    if (fs::is_regular_file(sideCar))
    {
      if (auto table = ParseIfLabelTable(ReadText(sideCar), sideCar.string()))
      {
        return table;
      }
    }
  }
  return std::nullopt;
}

} // namespace rhombic
