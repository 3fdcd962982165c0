#include "rhombicPhantom.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicScanWriter.h"
#include "rhombicWording.h"

#include "gdcmWriter.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iomanip>
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

constexpr char StagePrefix[] = ".phantom-"; // of hidden folders, then the number of the process

/** Removes the hidden folders of processes that were killed, on this machine. */
void
RemoveAbandoned(const fs::path & folder)
{
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    const std::string name = entry->path().filename().string();
    const std::string number = name.rfind(StagePrefix, 0) == 0 ? name.substr(std::strlen(StagePrefix)) : "";
    const bool isNumber = !number.empty() && number.size() < 10 &&
                          std::all_of(number.begin(), number.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (isNumber && kill(std::stoi(number), 0) != 0 && errno == ESRCH)
    {
      std::error_code ignored; // the folder is not empty then
      fs::remove_all(entry->path(), ignored);
    }
  }
}

/** Makes the folder unless it is there and empty. Returns whether it was made. */
bool
MakeFolder(const fs::path & folder)
{
  RemoveAbandoned(folder);
  std::error_code error;
  const bool isNew = fs::create_directory(folder, error);
  if (error || !fs::is_directory(folder, error))
  {
    Fail(folder, "the folder can't be made; create the folder above it, or choose another one");
  }
  const bool isEmpty = fs::is_empty(folder, error);
  if (error || !isEmpty)
  {
    Fail(folder, "the folder is not empty; give a new or an empty one");
  }
  return isNew;
}

void
WriteBytes(const fs::path & path, const std::string & bytes)
{
  AtomicFile output(path);
  std::ofstream stream(output.GetTemporaryPath(), std::ios::binary);
  if (!stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush())
  {
    Fail(path, "not all bytes arrived; check the space on the disk");
  }
  output.Commit(bytes.size());
}

/** Numbers as DICOM writes several in one element, each with at most 16 characters. */
std::string
Decimals(std::initializer_list<double> values)
{
  std::string text;
  for (const double value : values)
  {
    text += (text.empty() ? "" : "\\") + FormatNumber(value, 10);
  }
  return text;
}

/** The little-endian bytes of words. */
template <typename TIterator>
std::string
Words(TIterator first, TIterator last)
{
  std::string bytes;
  for (; first != last; ++first)
  {
    bytes += static_cast<char>(*first & 0xff);
    bytes += static_cast<char>(*first >> 8 & 0xff);
  }
  return bytes;
}

struct DICOMElement
{
  gdcm::Tag tag;
  gdcm::VR representation;
  std::string value;
};

/** A CT must have its dates, times, physician and tube voltage, but they may be empty. */
std::vector<DICOMElement>
DescribeSlice(const PhantomScan & scan, std::size_t slice)
{
  const auto spacing = scan.GetSpacing();
  const auto size = scan.GetLargestPossibleRegion().GetSize();
  PhantomScan::PointType corner;
  scan.TransformIndexToPhysicalPoint({ { 0, 0, static_cast<itk::IndexValueType>(slice) } }, corner);
  const std::string number = std::to_string(slice + 1);
  const std::string root = "2.25.295168077178222349515311917512233955794."; // from a UUID made for the phantom
  const std::string series = root + "1." + std::to_string(std::lround(1e6 * spacing[0]));
  const auto word = [](std::size_t value) { return Words(&value, &value + 1); };
  using VR = gdcm::VR;
  return { { { 0x0008, 0x0008 }, VR::CS, "ORIGINAL\\PRIMARY\\AXIAL" },
           { { 0x0008, 0x0016 }, VR::UI, "1.2.840.10008.5.1.4.1.1.2" }, // CT Image Storage
           { { 0x0008, 0x0018 }, VR::UI, series + ".3." + number },
           { { 0x0008, 0x0020 }, VR::DA, "" },
           { { 0x0008, 0x0030 }, VR::TM, "" },
           { { 0x0008, 0x0050 }, VR::SH, "" },
           { { 0x0008, 0x0060 }, VR::CS, "CT" },
           { { 0x0008, 0x0070 }, VR::LO, "Rhombic" },
           { { 0x0008, 0x0090 }, VR::PN, "" },
           { { 0x0008, 0x103e }, VR::LO, "Analytic phantom" },
           { { 0x0010, 0x0010 }, VR::PN, "PHANTOM" },
           { { 0x0010, 0x0020 }, VR::LO, "PHANTOM" },
           { { 0x0010, 0x0030 }, VR::DA, "" },
           { { 0x0010, 0x0040 }, VR::CS, "O" },
           { { 0x0018, 0x0050 }, VR::DS, Decimals({ spacing[2] }) },
           { { 0x0018, 0x0060 }, VR::DS, "" },
           { { 0x0018, 0x5100 }, VR::CS, "HFS" },
           { { 0x0020, 0x000d }, VR::UI, series + ".1" },
           { { 0x0020, 0x000e }, VR::UI, series + ".2" },
           { { 0x0020, 0x0010 }, VR::SH, "1" },
           { { 0x0020, 0x0011 }, VR::IS, "1" },
           { { 0x0020, 0x0012 }, VR::IS, "1" },
           { { 0x0020, 0x0013 }, VR::IS, number },
           { { 0x0020, 0x0032 }, VR::DS, Decimals({ corner[0], corner[1], corner[2] }) },
           { { 0x0020, 0x0037 }, VR::DS, Decimals({ 1, 0, 0, 0, 1, 0 }) },
           { { 0x0020, 0x0052 }, VR::UI, series + ".4" },
           { { 0x0020, 0x1040 }, VR::LO, "" },
           { { 0x0028, 0x0002 }, VR::US, word(1) }, // samples per pixel
           { { 0x0028, 0x0004 }, VR::CS, "MONOCHROME2" },
           { { 0x0028, 0x0010 }, VR::US, word(size[1]) }, // rows
           { { 0x0028, 0x0011 }, VR::US, word(size[0]) }, // columns
           { { 0x0028, 0x0030 }, VR::DS, Decimals({ spacing[1], spacing[0] }) },
           { { 0x0028, 0x0100 }, VR::US, word(16) }, // bits allocated, bits stored, high bit
           { { 0x0028, 0x0101 }, VR::US, word(16) },
           { { 0x0028, 0x0102 }, VR::US, word(15) },
           { { 0x0028, 0x0103 }, VR::US, word(1) }, // signed
           { { 0x0028, 0x1050 }, VR::DS, "40" },    // window
           { { 0x0028, 0x1051 }, VR::DS, "400" },
           { { 0x0028, 0x1052 }, VR::DS, "-1024" }, // added to the stored values, as scanners do
           { { 0x0028, 0x1053 }, VR::DS, "1" },
           { { 0x0028, 0x1054 }, VR::LO, "HU" } };
}

/** The stored values of a slice: Hounsfield units + 1024. */
std::string
PixelsOf(const PhantomScan & scan, std::size_t slice)
{
  const auto size = scan.GetLargestPossibleRegion().GetSize();
  const std::int16_t * const first = scan.GetBufferPointer() + slice * size[0] * size[1];
  std::vector<int> stored(size[0] * size[1]);
  std::transform(first, first + stored.size(), stored.begin(), [](int value) { return value + 1024; });
  return Words(stored.begin(), stored.end());
}

void
WriteSlice(const fs::path & path, const PhantomScan & scan, std::size_t slice)
{
  std::vector<DICOMElement> elements = DescribeSlice(scan, slice);
  elements.push_back({ { 0x7fe0, 0x0010 }, gdcm::VR::OW, PixelsOf(scan, slice) });
  gdcm::Writer writer;
  for (auto & [tag, representation, value] : elements)
  {
    if (value.size() % 2 != 0)
    {
      value += representation == gdcm::VR::UI ? '\0' : ' ';
    }
    gdcm::DataElement element(tag, 0, representation);
    element.SetByteValue(value.data(), static_cast<std::uint32_t>(value.size()));
    writer.GetFile().GetDataSet().Replace(element);
  }
  writer.GetFile().GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  std::ostringstream bytes; // GDCM ends the process when a disk is full
  writer.SetStream(bytes);
  if (!writer.Write())
  {
    Fail(path, "the DICOM writer failed");
  }
  WriteBytes(path, bytes.str());
}

void
WriteSeries(const fs::path & folder, const PhantomScan & scan)
{
  fs::create_directory(folder);
  for (std::size_t slice = 0; slice < scan.GetLargestPossibleRegion().GetSize()[2]; ++slice)
  {
    std::ostringstream name;
    name << "slice-" << std::setw(4) << std::setfill('0') << slice + 1 << ".dcm";
    WriteSlice(folder / name.str(), scan, slice);
  }
}

std::string
ColourOf(const PhantomOrgan & organ)
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
  std::string text = "name,label,hounsfield,volume_ml,colour\n";
  for (const PhantomOrgan & organ : PhantomOrgans())
  {
    text += organ.name + ',' + std::to_string(organ.label) + ',' + FormatFixed(organ.hounsfield, 0) + ',' +
            FormatFixed(organ.volume / CubicMillimetresPerMl, 3) + ',' + ColourOf(organ) + '\n';
  }
  return text;
}

/** The table of labels in the layout of BIDS. */
std::string
MakeLabelTable()
{
  std::string text = "index\tname\tcolor\n";
  for (const PhantomOrgan & organ : PhantomOrgans())
  {
    text += std::to_string(organ.label) + '\t' + organ.name + '\t' + ColourOf(organ) + '\n';
  }
  return text;
}

/** Removes a hidden folder at the end, and the folder around it if that was made for it and is empty. */
struct Cleaner
{
  fs::path hidden;
  fs::path folder;
  bool isNew;

  ~Cleaner()
  {
    std::error_code ignored; // nothing more can be done about files that can't be removed
    fs::remove_all(hidden, ignored);
    if (isNew && fs::is_empty(folder, ignored))
    {
      fs::remove(folder, ignored);
    }
  }
};

/** Writes all files into a new folder. */
void
WriteFiles(const fs::path & folder, const PhantomSettings & settings, const PhantomScan::Pointer & scan)
{
  fs::create_directory(folder);
  WriteSeries(folder / "dicom", *scan);
  WriteScan(scan, folder / "phantom.nii.gz");
  WriteScan(MakePhantomLabels(settings), folder / "phantom-labels.nii.gz");
  WriteBytes(folder / "phantom-labels.tsv", MakeLabelTable());
  WriteBytes(folder / "phantom-organs.csv", MakeOrganTable());
}

} // namespace

void
WritePhantom(const fs::path & folder, const PhantomSettings & settings)
{
  const auto scan = MakePhantomScan(settings);
  const bool isNew = MakeFolder(folder);
  const Cleaner cleaner{ folder / (StagePrefix + std::to_string(getpid())), folder, isNew };
  try
  {
    WriteFiles(cleaner.hidden, settings, scan);
    for (const auto name :
         { "dicom", "phantom.nii.gz", "phantom-labels.nii.gz", "phantom-labels.tsv", "phantom-organs.csv" })
    {
      fs::rename(cleaner.hidden / name, folder / name);
    }
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
