#include "rhombicDicomCapture.h"

#include "rhombicDicomHeader.h"
#include "rhombicFiles.h"
#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <gdcmDicts.h>
#include <gdcmGlobal.h>
#include <gdcmWriter.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr DicomTag StudyInstanceUID = 0x0020000d;

/** Elements of patient and study that every image has, if need be without a value (type 2 in PS3.3). */
constexpr DicomTag NeededTags[] = {
  0x00080020, // StudyDate
  0x00080030, // StudyTime
  0x00080050, // AccessionNumber
  0x00080090, // ReferringPhysicianName
  0x00100010, // PatientName
  0x00100020, // PatientID
  0x00100030, // PatientBirthDate
  0x00100040, // PatientSex
  0x00200010, // StudyID
};

/** Elements that are copied where the scan has them. */
constexpr DicomTag OptionalTags[] = {
  0x00080005, // SpecificCharacterSet, that of all copied texts
  0x00081030, // StudyDescription
  0x00100021, // IssuerOfPatientID
  0x00101010, // PatientAge
  0x00120062, // PatientIdentityRemoved
  0x00120063, // DeidentificationMethod
  0x00280303, // LongitudinalTemporalInformationModified
};

/** A number in the bytes of a US or AT element. */
std::string
LittleEndian(std::uint32_t number, std::size_t size)
{
  std::string bytes;
  for (std::size_t n = 0; n < size; ++n)
  {
    bytes += static_cast<char>(number >> 8 * n & 255);
  }
  return bytes;
}

void
SetValue(gdcm::DataSet & dataSet, DicomTag number, std::string value)
{
  const gdcm::Tag tag(number);
  const gdcm::VR type = gdcm::Global::GetInstance().GetDicts().GetDictEntry(tag).GetVR();
  value += value.size() % 2 == 0 ? "" : type == gdcm::VR::UI ? std::string(1, '\0') : " ";
  gdcm::DataElement element(tag);
  element.SetVR(type);
  element.SetByteValue(value.data(), static_cast<std::uint32_t>(value.size()));
  dataSet.Replace(element);
}

/** "2.25." and the digest as a UUID of version 8, in decimal digits. */
std::string
MakeUID(std::string hexadecimal)
{
  hexadecimal[12] = '8'; // the version
  hexadecimal[16] = "89ab"[hexadecimal[16] & 3];
  std::string decimal; // its lowest digit first
  for (const char digit : hexadecimal)
  {
    int carry = digit <= '9' ? digit - '0' : digit - 'a' + 10;
    for (std::size_t n = 0; n < decimal.size() || carry > 0; ++n)
    {
      decimal += n < decimal.size() ? "" : "0";
      carry += 16 * (decimal[n] - '0');
      decimal[n] = static_cast<char>('0' + carry % 10);
      carry /= 10;
    }
  }
  return "2.25." + std::string(decimal.rbegin(), decimal.rend());
}

std::uintmax_t
SizeOf(const DicomCapture & capture)
{
  return capture.frames.size() * std::uintmax_t{ capture.frames.front()->pixels.size() };
}

void
CheckCapture(const DicomCapture & capture)
{
  const bool hasAlpha = std::any_of(
    capture.frames.begin(), capture.frames.end(), [](const Picture * frame) { return frame->channels != 3; });
  if (hasAlpha || SizeOf(capture) >= std::numeric_limits<std::uint32_t>::max() - 1)
  {
    throw Failure(FailureKind::Usage,
                  "Cannot write " + capture.path.string() + ": " +
                    (hasAlpha ? "DICOM pictures are not transparent; choose pictures without transparency."
                              : "DICOM files hold less than 4 GB of pixels; choose smaller or fewer pictures."));
  }
}

/** Series and image, as PS3.3 wants them of Secondary Capture (A.8.1, A.8.4), but for the UIDs. */
void
DescribeImage(const DicomCapture & capture, std::size_t number, const std::string & software, gdcm::DataSet & dataSet)
{
  const Picture & first = *capture.frames.front();
  const std::string softwareName = software.substr(0, software.find(' '));
  SetValue(dataSet, 0x00080008, "DERIVED\\SECONDARY");                    // ImageType
  SetValue(dataSet, 0x00080060, "OT");                                    // Modality: other
  SetValue(dataSet, 0x00080064, "WSD");                                   // ConversionType: workstation
  SetValue(dataSet, 0x00080070, softwareName);                            // Manufacturer
  SetValue(dataSet, 0x0008103e, softwareName + ": surfaces of the scan"); // SeriesDescription
  SetValue(dataSet, 0x00181016, softwareName);                            // SecondaryCaptureDeviceManufacturer
  SetValue(dataSet, 0x00181019, software);                                // ...DeviceSoftwareVersions
  SetValue(dataSet, 0x00200011, "9000");                                  // SeriesNumber: behind the scanner's
  SetValue(dataSet, 0x00200013, std::to_string(number));                  // InstanceNumber
  SetValue(dataSet, 0x00200020, "");                                      // PatientOrientation: letters tell it
  SetValue(dataSet, 0x00200060, "");                                      // Laterality
  SetValue(dataSet, 0x00280002, LittleEndian(3, 2));                      // SamplesPerPixel
  SetValue(dataSet, 0x00280004, "RGB");                                   // PhotometricInterpretation
  SetValue(dataSet, 0x00280006, LittleEndian(0, 2));                      // PlanarConfiguration: pixel by pixel
  SetValue(dataSet, 0x00280010, LittleEndian(static_cast<std::uint32_t>(first.height), 2)); // Rows
  SetValue(dataSet, 0x00280011, LittleEndian(static_cast<std::uint32_t>(first.width), 2));  // Columns
  SetValue(dataSet, 0x00280100, LittleEndian(8, 2));                                        // BitsAllocated
  SetValue(dataSet, 0x00280101, LittleEndian(8, 2));                                        // BitsStored
  SetValue(dataSet, 0x00280102, LittleEndian(7, 2));                                        // HighBit
  SetValue(dataSet, 0x00280103, LittleEndian(0, 2)); // PixelRepresentation: unsigned
  SetValue(dataSet, 0x00280301, "YES");              // BurnedInAnnotation
  SetValue(dataSet, 0x00280302, "YES");              // RecognizableVisualFeatures: a face
  if (capture.frames.size() > 1)
  {
    const double milliseconds = 1000.0 * capture.secondsPerFrame;
    SetValue(dataSet, 0x00181063, FormatFixed(milliseconds, 3));          // FrameTime
    SetValue(dataSet, 0x00280008, std::to_string(capture.frames.size())); // NumberOfFrames
    SetValue(
      dataSet, 0x00280009, LittleEndian(0x0018, 2) + LittleEndian(0x1063, 2)); // FrameIncrementPointer: FrameTime
  }
}

/** The bytes of a file up to its pixels. */
std::string
EncodeHeader(const gdcm::DataSet & dataSet, std::uintmax_t pixels)
{
  std::ostringstream stream; // in memory: GDCM ends the process when a disk is full
  gdcm::Writer writer;
  writer.GetFile().GetHeader().SetDataSetTransferSyntax(gdcm::TransferSyntax::ExplicitVRLittleEndian);
  writer.GetFile().SetDataSet(dataSet);
  writer.SetStream(stream);
  if (!writer.Write())
  {
    throw Failure(FailureKind::Internal, "GDCM can't write a DICOM header; please report it.");
  }
  return stream.str() + LittleEndian(DicomTags::PixelData >> 16, 2) + LittleEndian(DicomTags::PixelData & 0xffff, 2) +
         "OB" + LittleEndian(0, 2) + LittleEndian(static_cast<std::uint32_t>(pixels + pixels % 2), 4);
}

/** Writes a file, and reads it back. */
void
StageFile(const std::string & header, const DicomCapture & capture, StagedFiles & staged)
{
  AtomicFile & file = staged.Begin(capture.path);
  const std::uintmax_t size = SizeOf(capture);
  {
    std::ofstream stream(file.GetTemporaryPath(), std::ios::binary);
    stream << header;
    for (const Picture * const frame : capture.frames)
    {
      stream.write(reinterpret_cast<const char *>(frame->pixels.data()),
                   static_cast<std::streamsize>(frame->pixels.size()));
    }
    stream << std::string(size % 2, '\0');
  }
  std::ifstream stream(file.GetTemporaryPath(), std::ios::binary);
  const auto isNext = [&stream](const void * expected, std::size_t count) {
    std::string bytes(count, '\0');
    return stream.read(bytes.data(), static_cast<std::streamsize>(count)) &&
           std::equal(bytes.begin(), bytes.end(), static_cast<const char *>(expected));
  };
  const bool isSame = isNext(header.data(), header.size()) &&
                      std::all_of(capture.frames.begin(), capture.frames.end(), [&isNext](const Picture * frame) {
                        return isNext(frame->pixels.data(), frame->pixels.size());
                      });
  if (!isSame)
  {
    throw Failure(FailureKind::Output,
                  "Cannot write " + capture.path.string() +
                    ": the file does not hold the same bytes; check the space on the disk.");
  }
  file.Flush(header.size() + size + size % 2);
}

} // namespace

DicomStudy::DicomStudy(const fs::path & scan, const ScanReadOptions & options)
  : m_Folder(fs::is_directory(scan) ? fs::canonical(scan) : fs::path())
{
  const Scan opened = OpenScan(scan, options).scan;
  if (opened.format != "DICOM")
  {
    throw Failure(
      FailureKind::Usage,
      scan.string() + " is " + opened.format +
        ", which has no study that DICOM pictures could belong to; leave out the DICOM pictures, or name the "
        "folder of the DICOM scan.");
  }
  std::set<DicomTag> wanted{ StudyInstanceUID, DicomTags::SeriesInstanceUID };
  wanted.insert(std::begin(NeededTags), std::end(NeededTags));
  wanted.insert(std::begin(OptionalTags), std::end(OptionalTags));
  const auto header = ReadDicomHeader(opened.files.front(), wanted);
  for (const DicomTag tag : wanted)
  {
    const bool isNeeded = std::count(std::begin(NeededTags), std::end(NeededTags), tag) > 0;
    if (header && (isNeeded || header->dataSet.Has(tag)))
    {
      m_Values[tag] = header->dataSet.GetText(tag);
    }
  }
  if (m_Values[StudyInstanceUID].empty())
  {
    throw Failure(
      FailureKind::Unreadable,
      "The files in " + scan.string() +
        " name no study (StudyInstanceUID) that DICOM pictures could belong to; leave out the DICOM pictures.");
  }
}

void
DicomStudy::CheckPath(const fs::path & path) const
{
  const fs::path place = fs::weakly_canonical(fs::absolute(path)).lexically_relative(m_Folder);
  if (!m_Folder.empty() && *place.begin() != "..")
  {
    throw Failure(FailureKind::Usage,
                  "The DICOM file " + path.string() +
                    " would be in the scan's own folder, and be read as a part of it; name a file elsewhere with -o.");
  }
}

void
DicomStudy::Stage(const std::vector<DicomCapture> & captures, const std::string & software, StagedFiles & staged) const
{
  Digest digest;
  digest.Add(software);
  for (const auto & [tag, value] : m_Values)
  {
    digest.Add(LittleEndian(tag, 4) + value + '\n');
  }
  for (const DicomCapture & capture : captures)
  {
    CheckCapture(capture);
    digest.Add(std::to_string(capture.frames.front()->width) + ' ' + std::to_string(capture.frames.size()) + ' ' +
               FormatNumber(capture.secondsPerFrame) + '\n');
    for (const Picture * const frame : capture.frames)
    {
      digest.Add(frame->pixels.data(), frame->pixels.size());
    }
  }
  const std::string name = digest.GetDigits();
  const auto uidOf = [&name](std::size_t part) {
    Digest ofPart;
    ofPart.Add(name + std::to_string(part));
    return MakeUID(ofPart.GetDigits());
  };
  for (std::size_t n = 0; n < captures.size(); ++n)
  {
    gdcm::DataSet dataSet;
    for (const auto & [tag, value] : m_Values)
    {
      SetValue(dataSet, tag, value);
    }
    DescribeImage(captures[n], n + 1, software, dataSet);
    const bool isMultiframe = captures[n].frames.size() > 1;
    SetValue(
      dataSet, DicomTags::SOPClassUID, isMultiframe ? "1.2.840.10008.5.1.4.1.1.7.4" : "1.2.840.10008.5.1.4.1.1.7");
    SetValue(dataSet, 0x00080018, uidOf(n + 1)); // SOPInstanceUID
    SetValue(dataSet, DicomTags::SeriesInstanceUID, uidOf(0));
    StageFile(EncodeHeader(dataSet, SizeOf(captures[n])), captures[n], staged);
  }
}

} // namespace rhombic
