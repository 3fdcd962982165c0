#include "rhombicFailure.h"
#include "rhombicFuzzBytes.h"
#include "rhombicFuzzProperty.h"
#include "rhombicLabelTableFormats.h"

using rhombic::LabelTable;
using rhombicfuzz::FuzzBytes;
using rhombicfuzz::Require;

namespace
{

/** Lines key=value. */
std::map<std::string, std::string>
KeyValuesIn(std::string_view text)
{
  std::map<std::string, std::string> keyValues;
  while (!text.empty())
  {
    const std::string_view line = text.substr(0, text.find('\n'));
    const std::size_t equals = std::min(line.find('='), line.size());
    keyValues[std::string(line.substr(0, equals))] = line.substr(std::min(equals + 1, line.size()));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return keyValues;
}

LabelTable
Parse(std::size_t kind, std::string_view text)
{
  switch (kind)
  {
    case 0:
      return rhombic::ParseLabelTable(text, "labels.txt");
    case 1:
      return rhombic::ParseLabelTable(text, "labels.ctbl");
    case 2:
      return rhombic::ParseCaretLabels(text, "labels.nii");
    default:
      return rhombic::LabelsOfSegments(KeyValuesIn(text), "labels.seg.nrrd");
  }
}

void
CheckTable(const LabelTable & table)
{
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    const rhombic::Label & label = table[i];
    Require(i == 0 || table[i - 1].value < label.value, "labels are sorted, each value once");
    Require(label.name == rhombic::SanitizeLabelName(label.name, label.value), "names are safe to show");
    Require(label.name.size() <= 100, "names are short");
    Require(label.opacity >= 0 && label.opacity <= 1, "the opacity is from 0 to 1");
    const std::string stem = rhombic::FileStemOf(label.name);
    Require(!stem.empty() && stem.size() <= 100 && stem[0] != '.' && stem[0] != '-', "names make names of files");
    Require(stem.find('/') == std::string::npos, "no name makes a folder");
  }
}

} // namespace

/** The first byte says what kind of table the rest is. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  FuzzBytes bytes(data, size);
  const std::size_t kind = bytes.TakeBelow(4);
  try
  {
    CheckTable(Parse(kind, bytes.Rest()));
  }
  catch (const rhombic::Failure & failure)
  {
    Require(failure.GetKind() == rhombic::FailureKind::Unreadable, "a bad table is unreadable");
  }
  return 0;
}
