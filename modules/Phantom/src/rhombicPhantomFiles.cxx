#include "rhombicPhantomFiles.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicScanWriter.h"

#include "gdcmWriter.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <iomanip>
#include <locale>
#include <sstream>
#include <system_error>
#include <vector>

#include <unistd.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

[[noreturn]] void
Fail(const fs::path & path, const std::string & why)
{
  throw Failure(FailureKind::Output, "Cannot write the phantom to " + path.string() + ": " + why + ".");
}

/** A hidden folder inside the target: what was written there appears at Commit(), or is gone. */
class StagingFolder
{
public:
  explicit StagingFolder(const fs::path & target)
    : m_Target(target)
    , m_Path(target / (".phantom-" + std::to_string(getpid())))
  {
    std::error_code error;
    m_MadeTarget = fs::create_directory(target, error);
    if (error || !fs::is_directory(target, error))
    {
      Fail(target, "the folder can't be made; create the folder above it, or choose another one");
    }
    const bool empty = fs::is_empty(target, error);
    if (error || !empty)
    {
      Fail(target, "the folder is not empty; give a new or an empty one");
    }
    if (!fs::create_directory(m_Path, error))
    {
      Fail(target, "no folder can be made in it; choose another one");
    }
  }

  ~StagingFolder()
  {
    std::error_code ignored; // nothing more can be done about files that won't go
    fs::remove_all(m_Path, ignored);
    if (m_MadeTarget && fs::is_empty(m_Target, ignored))
    {
      fs::remove(m_Target, ignored);
    }
  }

  StagingFolder(const StagingFolder &) = delete;
  StagingFolder &
  operator=(const StagingFolder &) = delete;

  const fs::path &
  GetPath() const
  {
    return m_Path;
  }

  void
  Commit()
  {
    std::vector<fs::path> entries;
    for (const auto & entry : fs::directory_iterator(m_Path))
    {
      entries.push_back(entry.path());
    }
    for (const auto & entry : entries)
    {
      fs::rename(entry, m_Target / entry.filename());
    }
  }

private:
  fs::path m_Target;
  fs::path m_Path;
  bool m_MadeTarget = false;
};

/** An element of text; several values are joined by backslashes. */
struct TextElement
{
  gdcm::Tag tag;
  gdcm::VR kind;
  std::string value;
};

void
Set(gdcm::DataSet & dataset, const std::vector<TextElement> & elements)
{
  for (const auto & [tag, kind, value] : elements)
  {
    std::string even = value;
    if (even.size() % 2 != 0)
    {
      even += kind == gdcm::VR::UI ? '\0' : ' ';
    }
    gdcm::DataElement element(tag, 0, kind);
    element.SetByteValue(even.data(), static_cast<std::uint32_t>(even.size()));
    dataset.Replace(element);
  }
}

/** Sets an element of 16-bit words. */
void
Set(gdcm::DataSet & dataset, const gdcm::Tag & tag, const gdcm::VR & kind, const std::vector<std::uint16_t> & words)
{
  std::string bytes;
  bytes.reserve(2 * words.size());
  for (const std::uint16_t word : words)
  {
    bytes += static_cast<char>(word & 0xffu);
    bytes += static_cast<char>(word >> 8u);
  }
  gdcm::DataElement element(tag, 0, kind);
  element.SetByteValue(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  dataset.Replace(element);
}

/** Decimal strings, at most the 16 characters that DICOM allows for each. */
std::string
Decimals(std::initializer_list<double> values)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(10);
  const char * separator = "";
  for (const double value : values)
  {
    text << separator << value;
    separator = "\\";
  }
  return text.str();
}

/** Identifiers of the phantom: under the arc of a UUID made for it once. */
std::string
MakeIdentifier(const std::string & tail)
{
  return "2.25.295168077178222349515311917512233955794." + tail;
}

constexpr int RescaleIntercept = -1024; // as scanners store Hounsfield units

void
SetIdentity(gdcm::DataSet & dataset, const PhantomSettings & settings, std::size_t slice)
{
  const std::string series = "1." + std::to_string(std::lround(1e6 * settings.spacing));
  const std::string number = std::to_string(slice + 1);
  // A CT must have its dates, times, physician and tube voltage, but may leave them empty.
  Set(dataset,
      { { { 0x0008, 0x0008 }, gdcm::VR::CS, "ORIGINAL\\PRIMARY\\AXIAL" },
        { { 0x0008, 0x0016 }, gdcm::VR::UI, "1.2.840.10008.5.1.4.1.1.2" }, // CT Image Storage
        { { 0x0008, 0x0018 }, gdcm::VR::UI, MakeIdentifier(series + ".3." + number) },
        { { 0x0008, 0x0020 }, gdcm::VR::DA, "" },
        { { 0x0008, 0x0030 }, gdcm::VR::TM, "" },
        { { 0x0008, 0x0050 }, gdcm::VR::SH, "" },
        { { 0x0008, 0x0060 }, gdcm::VR::CS, "CT" },
        { { 0x0008, 0x0070 }, gdcm::VR::LO, "Rhombic" },
        { { 0x0008, 0x0090 }, gdcm::VR::PN, "" },
        { { 0x0008, 0x103e }, gdcm::VR::LO, "Analytic phantom" },
        { { 0x0010, 0x0010 }, gdcm::VR::PN, "PHANTOM" },
        { { 0x0010, 0x0020 }, gdcm::VR::LO, "PHANTOM" },
        { { 0x0010, 0x0030 }, gdcm::VR::DA, "" },
        { { 0x0010, 0x0040 }, gdcm::VR::CS, "O" },
        { { 0x0018, 0x0060 }, gdcm::VR::DS, "" },
        { { 0x0018, 0x5100 }, gdcm::VR::CS, "HFS" },
        { { 0x0020, 0x000d }, gdcm::VR::UI, MakeIdentifier(series + ".1") },
        { { 0x0020, 0x000e }, gdcm::VR::UI, MakeIdentifier(series + ".2") },
        { { 0x0020, 0x0010 }, gdcm::VR::SH, "1" },
        { { 0x0020, 0x0011 }, gdcm::VR::IS, "1" },
        { { 0x0020, 0x0012 }, gdcm::VR::IS, "1" },
        { { 0x0020, 0x0013 }, gdcm::VR::IS, number },
        { { 0x0020, 0x0052 }, gdcm::VR::UI, MakeIdentifier(series + ".4") },
        { { 0x0020, 0x1040 }, gdcm::VR::LO, "" } });
}

void
SetGeometry(gdcm::DataSet & dataset, const PhantomScan & scan, std::size_t slice)
{
  const auto & spacing = scan.GetSpacing();
  const PhantomScan::IndexType index{ { 0, 0, static_cast<itk::IndexValueType>(slice) } };
  PhantomScan::PointType corner;
  scan.TransformIndexToPhysicalPoint(index, corner);
  Set(dataset,
      { { { 0x0018, 0x0050 }, gdcm::VR::DS, Decimals({ spacing[2] }) },
        { { 0x0020, 0x0032 }, gdcm::VR::DS, Decimals({ corner[0], corner[1], corner[2] }) },
        { { 0x0020, 0x0037 }, gdcm::VR::DS, Decimals({ 1, 0, 0, 0, 1, 0 }) },
        { { 0x0028, 0x0030 }, gdcm::VR::DS, Decimals({ spacing[1], spacing[0] }) } });
}

void
SetPixels(gdcm::DataSet & dataset, const PhantomScan & scan, std::size_t slice)
{
  const auto & size = scan.GetLargestPossibleRegion().GetSize();
  const auto setWord = [&dataset](std::uint16_t element, std::size_t value) {
    Set(dataset, { 0x0028, element }, gdcm::VR::US, { static_cast<std::uint16_t>(value) });
  };
  setWord(0x0002, 1);       // samples per pixel
  setWord(0x0010, size[1]); // rows
  setWord(0x0011, size[0]); // columns
  setWord(0x0100, 16);      // bits allocated, bits stored, high bit
  setWord(0x0101, 16);
  setWord(0x0102, 15);
  setWord(0x0103, 1); // signed
  Set(dataset,
      { { { 0x0028, 0x0004 }, gdcm::VR::CS, "MONOCHROME2" },
        { { 0x0028, 0x1050 }, gdcm::VR::DS, "40" }, // window
        { { 0x0028, 0x1051 }, gdcm::VR::DS, "400" },
        { { 0x0028, 0x1052 }, gdcm::VR::DS, std::to_string(RescaleIntercept) },
        { { 0x0028, 0x1053 }, gdcm::VR::DS, "1" },
        { { 0x0028, 0x1054 }, gdcm::VR::LO, "HU" } });

  const std::size_t count = size[0] * size[1];
  const std::int16_t * first = scan.GetBufferPointer() + slice * count;
  std::vector<std::uint16_t> words(count);
  std::transform(first, first + count, words.begin(), [](int value) {
    return static_cast<std::uint16_t>(value - RescaleIntercept);
  });
  Set(dataset, { 0x7fe0, 0x0010 }, gdcm::VR::OW, words);
}

void
WriteSlice(const fs::path & path, const PhantomScan & scan, const PhantomSettings & settings, std::size_t slice)
{
  AtomicFile output(path);
  gdcm::Writer writer;
  auto & dataset = writer.GetFile().GetDataSet();
  SetIdentity(dataset, settings, slice);
  SetGeometry(dataset, scan, slice);
  SetPixels(dataset, scan, slice);
  writer.GetFile().GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  std::ostringstream bytes; // GDCM ends the process when a disk is full
  writer.SetStream(bytes);
  if (!writer.Write())
  {
    Fail(path, "the DICOM writer failed");
  }
  const std::string content = bytes.str();
  std::ofstream stream(output.GetTemporaryPath(), std::ios::binary);
  if (!stream.write(content.data(), static_cast<std::streamsize>(content.size())).flush())
  {
    Fail(path, "not all bytes arrived; check the space on the disk");
  }
  output.Commit(content.size());
}

void
WriteSeries(const fs::path & folder, const PhantomScan & scan, const PhantomSettings & settings)
{
  fs::create_directory(folder);
  for (std::size_t slice = 0; slice < scan.GetLargestPossibleRegion().GetSize()[2]; ++slice)
  {
    std::ostringstream name;
    name << "slice-" << std::setw(4) << std::setfill('0') << slice + 1 << ".dcm";
    WriteSlice(folder / name.str(), scan, settings, slice);
  }
}

std::string
DescribeColour(const PhantomOrgan & organ)
{
  std::ostringstream text;
  text << '#' << std::hex << std::setfill('0');
  for (const float channel : organ.colour)
  {
    text << std::setw(2) << std::lround(255.0f * channel);
  }
  return text.str();
}

std::string
MakeOrganTable()
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << "name,label,hounsfield,volume_ml,colour\n" << std::fixed;
  for (const PhantomOrgan & organ : PhantomOrgans())
  {
    text << organ.name << ',' << organ.label << ',' << std::setprecision(0) << organ.hounsfield << ','
         << std::setprecision(3) << organ.volume / 1000.0 << ',' << DescribeColour(organ) << '\n';
  }
  return text.str();
}

/** As BIDS has it. */
std::string
MakeLabelTable()
{
  std::string text = "index\tname\tcolor\n";
  for (const PhantomOrgan & organ : PhantomOrgans())
  {
    text += std::to_string(organ.label) + '\t' + organ.name + '\t' + DescribeColour(organ) + '\n';
  }
  return text;
}

void
WriteTable(const fs::path & path, const std::string & table)
{
  AtomicFile output(path);
  std::ofstream stream(output.GetTemporaryPath(), std::ios::binary);
  stream << table;
  stream.close();
  if (!stream)
  {
    Fail(path, "the table could not be written; check the space on the disk");
  }
  output.Commit(table.size());
}

} // namespace

void
WritePhantom(const fs::path & folder, const PhantomSettings & settings)
{
  const auto scan = MakePhantomScan(settings);
  try
  {
    StagingFolder staging(folder);
    WriteSeries(staging.GetPath() / "dicom", *scan, settings);
    WriteScan(scan, staging.GetPath() / "phantom.nii.gz");
    WriteScan(MakePhantomLabels(settings), staging.GetPath() / "phantom-labels.nii.gz");
    WriteTable(staging.GetPath() / "phantom-labels.tsv", MakeLabelTable());
    WriteTable(staging.GetPath() / "phantom-organs.csv", MakeOrganTable());
    staging.Commit();
  }
  catch (const Failure &)
  {
    throw;
  }
  catch (const itk::ExceptionObject & exception)
  {
    Fail(folder, exception.GetDescription() + std::string("; check the space on the disk"));
  }
  catch (const fs::filesystem_error & error)
  {
    Fail(folder, error.code().message() + "; choose another folder");
  }
}

} // namespace rhombic
