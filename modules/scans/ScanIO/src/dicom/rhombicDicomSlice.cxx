#include "rhombicDicomSlice.h"

#include "rhombicWording.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace rhombic
{
namespace
{

bool
IsSegmentation(const DicomDataSet & dataSet)
{
  const std::string uid = dataSet.GetText(DicomTags::SOPClassUID);
  return uid == "1.2.840.10008.5.1.4.1.1.66.4" || uid == "1.2.840.10008.5.1.4.1.1.66.7";
}

/** The digits and dots of a unique identifier. */
std::string
IdentifierOf(std::string text)
{
  constexpr std::size_t longest = 64;
  const auto isOther = [](char letter) { return letter != '.' && (letter < '0' || letter > '9'); };
  text.erase(std::remove_if(text.begin(), text.end(), isOther), text.end());
  return text.substr(0, longest);
}

DicomPixelFormat
ReadPixelFormat(const DicomHeader & header)
{
  const DicomDataSet & dataSet = header.dataSet;
  DicomPixelFormat format;
  format.transferSyntax = header.transferSyntax;
  format.isEncapsulated = header.isEncapsulated;
  format.columns = dataSet.GetShort(DicomTags::Columns).value_or(0);
  format.rows = dataSet.GetShort(DicomTags::Rows).value_or(0);
  const auto frames = dataSet.GetDecimals(DicomTags::NumberOfFrames);
  format.frames =
    frames.empty() || !(frames[0] >= 1 && frames[0] < 4294967296.0) ? 1 : static_cast<std::size_t>(frames[0]);
  format.bitsAllocated = dataSet.GetShort(DicomTags::BitsAllocated).value_or(0);
  format.swappedBytes = dataSet.isBigEndian ? std::max(format.bitsAllocated / 8, header.hasWords ? 2U : 1U) : 1;
  format.bitsStored = dataSet.GetShort(DicomTags::BitsStored).value_or(0);
  format.highBit = dataSet.GetShort(DicomTags::HighBit).value_or(static_cast<std::uint16_t>(format.bitsStored - 1));
  format.isSigned = dataSet.GetShort(DicomTags::PixelRepresentation) == 1;

  const auto stored = [&format](std::uint16_t value) {
    return format.isSigned ? std::int64_t{ static_cast<std::int16_t>(value) } : std::int64_t{ value };
  };
  if (const auto value = dataSet.GetShort(DicomTags::PixelPaddingValue))
  {
    const std::int64_t first = stored(*value);
    const std::int64_t last = stored(dataSet.GetShort(DicomTags::PixelPaddingRangeLimit).value_or(*value));
    format.padding = std::minmax(first, last);
  }
  return format;
}

/** Why the file lacks pixels that its header describes; empty if it has all. */
std::string
FindPixelDamage(const DicomHeader & header, const DicomPixelFormat & format)
{
  if (!header.damage.empty())
  {
    return header.damage;
  }
  if (!header.hasPixels)
  {
    return "it has no pixels";
  }
  const PixelCodec codec = FindTransferSyntax(format.transferSyntax).codec;
  if (format.isEncapsulated != (codec != PixelCodec::None))
  {
    return "its transfer syntax and the form of its pixels contradict each other";
  }
  if (format.isEncapsulated)
  {
    return header.fragments.size() < format.frames ? "its compressed pixels are missing" : "";
  }
  const std::string photometric = header.dataSet.GetText(DicomTags::PhotometricInterpretation);
  const bool sharesColours = photometric == "YBR_FULL_422" || photometric == "YBR_PARTIAL_422"; // of two pixels
  const std::uintmax_t samples =
    sharesColours ? 2 : std::clamp<unsigned int>(header.dataSet.GetShort(DicomTags::SamplesPerPixel).value_or(1), 1, 4);
  const std::uintmax_t pixels = std::uintmax_t{ format.columns } * format.rows * format.frames * samples;
  const std::uintmax_t needed = (pixels * format.bitsAllocated + 7) / 8;
  const std::uintmax_t claimed = header.pixels.size;
  const std::uintmax_t available = header.fileSize - header.pixels.offset;
  if (claimed < needed || available < claimed)
  {
    return "it has " + std::to_string(std::min(claimed, available)) + " of " +
           std::to_string(std::max(claimed, needed)) + " bytes of pixels";
  }
  constexpr std::uintmax_t mostPadding = 1024; // more than any known writer appends
  if (claimed - needed > std::min(mostPadding, needed / 2 + 2))
  {
    return "it has " + std::to_string(claimed) + " bytes of pixels where its header says " + std::to_string(needed);
  }
  return "";
}

/** Why a kind of image can't be a slice of a volume, as "it ..."; empty if it can. */
std::string
FindRefusal(const DicomDataSet & dataSet, const DicomPixelFormat & format)
{
  const std::string kind = dataSet.GetText(DicomTags::SOPClassUID);
  const std::string photometric = dataSet.GetText(DicomTags::PhotometricInterpretation);
  const auto samples = dataSet.GetShort(DicomTags::SamplesPerPixel).value_or(0);
  const TransferSyntax syntax = FindTransferSyntax(format.transferSyntax);
  if (kind == "1.2.840.10008.5.1.4.1.1.30")
  {
    return "it is a parametric map";
  }
  if (kind == "1.2.840.10008.5.1.4.1.1.481.2")
  {
    return "it is a radiotherapy dose (RTDOSE)";
  }
  if (syntax.codec == PixelCodec::Unsupported)
  {
    return "its transfer syntax " + IdentifierOf(format.transferSyntax) + " (" + syntax.name + ") is not supported";
  }
  if (photometric == "MONOCHROME1")
  {
    return "its grey values are inverted (MONOCHROME1)";
  }
  if (photometric == "PALETTE COLOR" || samples > 1)
  {
    return "it is a colour image";
  }
  if (photometric != "MONOCHROME2" || samples != 1)
  {
    return "its kind of pixels (photometric interpretation, samples per pixel) is not supported";
  }
  return dataSet.GetItems(DicomTags::ModalityLUTSequence).empty()
           ? ""
           : "its values go through a table (Modality LUT), which is not supported";
}

/** As FindRefusal(), of pixels that no image can have, and of those with sizes that are not supported. */
std::string
FindBitsRefusal(const DicomDataSet & dataSet, const DicomPixelFormat & format)
{
  const bool isByteWise = format.bitsAllocated == 8 || format.bitsAllocated == 16 || format.bitsAllocated == 32;
  if ((!isByteWise && !(IsSegmentation(dataSet) && format.bitsAllocated == 1)) || format.bitsStored == 0 ||
      format.bitsStored > format.bitsAllocated || format.highBit >= format.bitsAllocated ||
      format.highBit + 1 < format.bitsStored)
  {
    return "its pixels have " + std::to_string(format.bitsStored) + " of " + std::to_string(format.bitsAllocated) +
           " bits, which is not supported";
  }
  if (dataSet.GetShort(DicomTags::PixelRepresentation).value_or(2) > 1 && !IsSegmentation(dataSet))
  {
    return "it does not say whether its pixels have a sign (PixelRepresentation)";
  }
  return "";
}

bool
HasScaling(const DicomDataSet & dataSet)
{
  return dataSet.Has(DicomTags::RescaleSlope) || dataSet.Has(DicomTags::RescaleIntercept);
}

/** Fills in slope and intercept, or the refusal when they are not usable. */
void
ReadScaling(const DicomDataSet & dataSet, DicomSlice & slice)
{
  const bool isGiven =
    !dataSet.GetText(DicomTags::RescaleSlope).empty() || !dataSet.GetText(DicomTags::RescaleIntercept).empty();
  const auto read = [&dataSet, isGiven](DicomTag tag, double absent) {
    const auto numbers = dataSet.GetDecimals(tag);
    const bool isAbsent =
      dataSet.GetText(tag).empty() && !(isGiven && dataSet.Has(tag)); // an empty one beside the other is not
    return isAbsent ? absent : numbers.size() == 1 ? numbers[0] : std::nan("");
  };
  slice.isScaled = isGiven;
  slice.slope = read(DicomTags::RescaleSlope, 1);
  slice.intercept = read(DicomTags::RescaleIntercept, 0);
  if (slice.refusal.empty() && (!std::isfinite(slice.slope) || slice.slope == 0 || !std::isfinite(slice.intercept)))
  {
    slice.refusal = "its RescaleSlope or RescaleIntercept is no usable number";
  }
  const double largest = std::ldexp(std::abs(slice.slope), static_cast<int>(slice.file->format.bitsStored));
  if (slice.refusal.empty() && !(largest + std::abs(slice.intercept) <= std::numeric_limits<float>::max()))
  {
    slice.refusal = "its RescaleSlope or RescaleIntercept makes its values larger than numbers can be";
  }
}

/** Reads a plain slice, whose description is in the data set itself. */
void
ReadPlainSlice(const DicomDataSet & dataSet, DicomSlice & slice)
{
  const auto named = [&dataSet](const char * name, DicomTag tag) {
    const std::string value = NumberTextOf(dataSet.GetText(tag));
    return value.empty() ? "" : name + value;
  };
  const std::string stack = dataSet.GetText(DicomTags::StackID);
  slice.distinctions = { ImageTypeOf(dataSet.GetText(DicomTags::ImageType)),
                         named("echo time ", DicomTags::EchoTime) + named(" echo ", DicomTags::EchoNumbers),
                         named("time ", DicomTags::TemporalPositionIdentifier),
                         stack.empty() ? "" : "stack " + NameCodeOf(stack),
                         named("acquisition ", DicomTags::AcquisitionNumber) };
  ReadScaling(dataSet, slice);
  const auto step = dataSet.GetDecimals(DicomTags::SpacingBetweenSlices);
  const bool isMR = dataSet.GetText(DicomTags::SOPClassUID) == "1.2.840.10008.5.1.4.1.1.4";
  slice.isOther =
    slice.isOther || !(dataSet.Has(DicomTags::ImagePositionPatient) || dataSet.Has(DicomTags::ImageOrientationPatient));
  slice.step = isMR && step.size() == 1 && step[0] > 0 ? step[0] : 1;
  slice.plane = MakeSlicePlane(dataSet.GetDecimals(DicomTags::ImagePositionPatient),
                               dataSet.GetDecimals(DicomTags::ImageOrientationPatient),
                               dataSet.GetDecimals(DicomTags::PixelSpacing),
                               slice.planeProblem);
}

/** Reads a frame of an enhanced object (PS3.3, C.7.6.16). */
void
ReadFrame(const DicomDataSet & dataSet, std::size_t frame, DicomSlice & slice)
{
  // The functional groups of a frame are its own, or else those that all frames share.
  const DicomDataSet & shared = dataSet.GetItem(DicomTags::SharedFunctionalGroupsSequence);
  const DicomDataSet & own = dataSet.GetItems(DicomTags::PerFrameFunctionalGroupsSequence)[frame];
  const auto group = [&](DicomTag sequence) -> const DicomDataSet & {
    return own.Has(sequence) ? own.GetItem(sequence) : shared.GetItem(sequence);
  };
  const DicomDataSet & content = group(DicomTags::FrameContentSequence);
  const auto echo = group(DicomTags::MREchoSequence).GetDouble(DicomTags::EffectiveEchoTime);
  const auto times = content.GetShorts(DicomTags::TemporalPositionIndex);
  slice.frame = frame;
  const std::string stack = content.GetText(DicomTags::StackID);
  slice.distinctions = { ImageTypeOf(group(DicomTags::MRImageFrameTypeSequence).GetText(DicomTags::FrameType) +
                                     group(DicomTags::CTImageFrameTypeSequence).GetText(DicomTags::FrameType)),
                         echo ? "echo time " + FormatFixed(*echo, 6) : "",
                         times.empty() ? "" : "time " + std::to_string(times[0]),
                         stack.empty() ? "" : "stack " + NameCodeOf(stack),
                         "" };
  if (slice.kind == DicomSlice::Kind::Scan)
  {
    const DicomDataSet & values = group(DicomTags::PixelValueTransformationSequence);
    ReadScaling(HasScaling(values) ? values : dataSet, slice);
    const bool isEnhancedCT = dataSet.GetText(DicomTags::SOPClassUID) == "1.2.840.10008.5.1.4.1.1.2.1";
    if (slice.refusal.empty() && isEnhancedCT && !HasScaling(values) && !HasScaling(dataSet))
    {
      slice.refusal = "it is an enhanced CT image that does not say which HU its values are";
    }
  }
  slice.plane =
    MakeSlicePlane(group(DicomTags::PlanePositionSequence).GetDecimals(DicomTags::ImagePositionPatient),
                   group(DicomTags::PlaneOrientationSequence).GetDecimals(DicomTags::ImageOrientationPatient),
                   group(DicomTags::PixelMeasuresSequence).GetDecimals(DicomTags::PixelSpacing),
                   slice.planeProblem);
}

} // namespace

itk::Vector<double, 3>
NormalOf(const SlicePlane & plane)
{
  auto normal = itk::CrossProduct(plane.columnStep, plane.rowStep);
  normal.Normalize();
  return normal;
}

std::optional<SlicePlane>
MakeSlicePlane(const std::vector<double> & position,
               const std::vector<double> & orientation,
               const std::vector<double> & spacing,
               std::string & problem)
{
  // Within these limits, no sum or product overflows or becomes 0.
  constexpr double farthest = 1e7;
  constexpr double smallest = 1e-6;
  const auto isPlace = [](double number) { return std::abs(number) <= farthest; };
  const auto isStep = [](double number) { return number >= smallest && number <= farthest; };
  const bool isPlaced = position.size() == 3 && std::all_of(position.begin(), position.end(), isPlace);
  const bool isSpaced = spacing.size() == 2 && isStep(spacing[0]) && isStep(spacing[1]);
  if (!isPlaced || orientation.size() != 6 || !isSpaced)
  {
    problem = std::string("it has no usable ") + (!isPlaced                 ? "ImagePositionPatient"
                                                  : orientation.size() != 6 ? "ImageOrientationPatient"
                                                                            : "PixelSpacing");
    return {};
  }
  itk::Vector<double, 3> alongRow(orientation.data());
  itk::Vector<double, 3> alongColumn(orientation.data() + 3);
  constexpr double tolerance = 1e-3;
  if (!(std::abs(alongRow.GetNorm() - 1) <= tolerance && std::abs(alongColumn.GetNorm() - 1) <= tolerance &&
        std::abs(alongRow * alongColumn) <= tolerance))
  {
    problem = "the two axes of its ImageOrientationPatient are not perpendicular unit vectors";
    return {};
  }
  alongRow.Normalize();
  alongColumn.Normalize();
  SlicePlane plane;
  plane.position = itk::Point<double, 3>(position.data());
  plane.columnStep = alongRow * spacing[1]; // DICOM gives the distance between rows first
  plane.rowStep = alongColumn * spacing[0];
  return plane;
}

std::vector<DicomSlice>
ReadDicomSlices(const std::filesystem::path & path)
{
  const auto header = ReadDicomHeader(path);
  if (!header)
  {
    return {};
  }
  const DicomDataSet & dataSet = header->dataSet;
  const auto file = std::make_shared<DicomImageFile>();
  file->path = path;
  file->format = ReadPixelFormat(*header);
  file->pixels = header->pixels;
  file->fragments = header->fragments;
  file->pixelDamage = FindPixelDamage(*header, file->format);

  DicomSlice slice;
  slice.file = file;
  slice.seriesUID = dataSet.GetText(DicomTags::SeriesInstanceUID);
  slice.seriesNumber = NumberTextOf(dataSet.GetText(DicomTags::SeriesNumber));
  slice.modality = ModalityOf(dataSet.GetText(DicomTags::Modality));
  if (file->format.rows == 0 || file->format.columns == 0 || (!header->hasPixels && header->damage.empty()))
  {
    const bool isUnreadable = FindTransferSyntax(header->transferSyntax).codec == PixelCodec::Unsupported;
    slice.kind = isUnreadable ? DicomSlice::Kind::Scan : DicomSlice::Kind::NoImage;
    slice.isOther = isUnreadable;
    slice.refusal = isUnreadable             ? FindRefusal(dataSet, file->format)
                    : header->damage.empty() ? "it holds no image (a report, plan or the like)"
                                             : header->damage;
    return { slice };
  }
  if (IsSegmentation(dataSet))
  {
    slice.kind = DicomSlice::Kind::Segmentation;
    file->segmentation = std::make_shared<DicomDataSet>(dataSet);
  }
  slice.refusal = FindRefusal(dataSet, file->format);
  slice.isOther = slice.kind == DicomSlice::Kind::Scan && !slice.refusal.empty();
  slice.refusal = slice.refusal.empty() ? FindBitsRefusal(dataSet, file->format) : slice.refusal;

  const std::size_t frames = dataSet.GetItems(DicomTags::PerFrameFunctionalGroupsSequence).size();
  if (frames == 0 && slice.kind == DicomSlice::Kind::Segmentation && slice.refusal.empty())
  {
    slice.refusal = "it is a DICOM segmentation (SEG) that does not say where its frames are";
    return { slice };
  }
  if (frames == 0 && file->format.frames == 1)
  {
    ReadPlainSlice(dataSet, slice);
    return { slice };
  }
  if (frames != file->format.frames)
  {
    slice.isOther = slice.isOther || slice.refusal.empty();
    slice.refusal =
      slice.refusal.empty() ? "it is a multi-frame image that does not say where its frames are" : slice.refusal;
    return { slice };
  }
  std::vector<DicomSlice> slices(frames, slice);
  for (std::size_t frame = 0; frame < frames; ++frame)
  {
    ReadFrame(dataSet, frame, slices[frame]);
  }
  return slices;
}

std::string
NameOf(const DicomSlice & slice)
{
  return slice.file->path.filename().string() +
         (slice.file->format.frames > 1 ? " (frame " + std::to_string(slice.frame + 1) + ")" : "");
}

TransferSyntax
FindTransferSyntax(const std::string & uid)
{
  static const std::map<std::string, TransferSyntax> known{
    { "", { "little endian", PixelCodec::None, false } },
    { "1.2.840.10008.1.2", { "implicit little endian", PixelCodec::None, false } },
    { "1.2.840.10008.1.2.1", { "explicit little endian", PixelCodec::None, false } },
    { "1.2.840.10008.1.2.2", { "explicit big endian", PixelCodec::None, false } },
    { "1.2.840.10008.1.2.1.99", { "deflated explicit little endian", PixelCodec::Unsupported, false } },
    { "1.2.840.10008.1.2.4.50", { "JPEG baseline", PixelCodec::JPEG, true } },
    { "1.2.840.10008.1.2.4.51", { "JPEG extended", PixelCodec::JPEG, true } },
    { "1.2.840.10008.1.2.4.57", { "JPEG lossless", PixelCodec::JPEG, false } },
    { "1.2.840.10008.1.2.4.70", { "JPEG lossless (first-order prediction)", PixelCodec::JPEG, false } },
    { "1.2.840.10008.1.2.4.80", { "JPEG-LS lossless", PixelCodec::JPEGLS, false } },
    { "1.2.840.10008.1.2.4.81", { "JPEG-LS near-lossless", PixelCodec::JPEGLS, true } },
    { "1.2.840.10008.1.2.4.90", { "JPEG 2000 lossless", PixelCodec::JPEG2000, false } },
    { "1.2.840.10008.1.2.4.91", { "JPEG 2000", PixelCodec::JPEG2000, true } },
    { "1.2.840.10008.1.2.4.201", { "high-throughput JPEG 2000 lossless", PixelCodec::Unsupported, false } },
    { "1.2.840.10008.1.2.4.202", { "high-throughput JPEG 2000 lossless", PixelCodec::Unsupported, false } },
    { "1.2.840.10008.1.2.4.203", { "high-throughput JPEG 2000", PixelCodec::Unsupported, true } },
    { "1.2.840.10008.1.2.5", { "RLE lossless", PixelCodec::RunLength, false } },
    { "1.2.840.10008.1.2.8.1", { "deflated frames", PixelCodec::Unsupported, false } },
  };
  const auto found = known.find(uid);
  return found == known.end() ? TransferSyntax{ "unknown", PixelCodec::Unsupported, false } : found->second;
}

} // namespace rhombic
