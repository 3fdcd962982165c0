#ifndef rhombicDicomSlice_h
#define rhombicDicomSlice_h

#include "rhombicDicomHeader.h"

#include "itkPoint.h"
#include "itkVector.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace rhombic
{

/** Where a slice is, in LPS millimetres. */
struct SlicePlane
{
  itk::Point<double, 3> position;    ///< centre of the first pixel
  itk::Vector<double, 3> columnStep; ///< from a pixel to the next in its row
  itk::Vector<double, 3> rowStep;    ///< from a row to the next
};

/** How the pixels of a DICOM file are stored. */
struct DicomPixelFormat
{
  std::string transferSyntax;    ///< UID
  unsigned int swappedBytes = 1; ///< how many bytes follow each other in the wrong order for this machine
  bool isEncapsulated = false;
  unsigned int columns = 0;
  unsigned int rows = 0;
  std::size_t frames = 1;
  unsigned int bitsAllocated = 0; ///< 1, 8, 16 or 32
  unsigned int bitsStored = 0;
  unsigned int highBit = 0;
  bool isSigned = false;

  /** Stored values that stand for "outside the scanner's view", from the first to the second. */
  std::optional<std::pair<std::int64_t, std::int64_t>> padding;

  /** Padding, if there is any, may use bits that values don't: it is told by all the bits that there are. */
  template <typename TRaw>
  bool
  IsPadding(TRaw raw) const
  {
    const auto value =
      isSigned ? std::int64_t{ static_cast<std::make_signed_t<TRaw>>(raw) } : static_cast<std::int64_t>(raw);
    return value >= padding->first && value <= padding->second;
  }

  std::size_t
  FrameBytes() const
  {
    return static_cast<std::size_t>(columns) * rows * (bitsAllocated / 8);
  }
};

/** A DICOM file with an image. */
struct DicomImageFile
{
  std::filesystem::path path;
  DicomPixelFormat format;
  ByteRange pixels;
  std::vector<ByteRange> fragments;
  std::string pixelDamage; ///< "it ..." when the pixels are not all there
};

/** One frame of a DICOM file, as its header has it. */
struct DicomSlice
{
  /** What the frames of a file are for. */
  enum class Kind
  {
    Scan,
    Segmentation, ///< a DICOM SEG object that can be read
    NoImage       ///< a report, a plan, or damaged
  };

  /** What tells slices at one place apart, in the order in which it is tried: type of the image, echo, time, stack,
   * acquisition. */
  static constexpr std::size_t NumberOfDistinctions = 5;

  std::shared_ptr<const DicomImageFile> file;
  std::size_t frame = 0;
  Kind kind = Kind::Scan;
  std::string seriesUID;
  std::string seriesNumber;
  std::string modality;
  std::array<std::string, NumberOfDistinctions> distinctions;
  double slope = 1;
  double intercept = 0;
  std::optional<SlicePlane> plane; ///< absent when the header does not give it
  std::string planeProblem;        ///< why it is absent
  std::string refusal;             ///< why it can't be a slice of a volume ("it is ..."); empty when it can
};

/** The slices of a file, one for each frame whose place is known and at least one. Nothing when the file is not DICOM.
 */
std::vector<DicomSlice>
ReadDicomSlices(const std::filesystem::path & path);

/** The plane that position, orientation and spacing make; nothing, and a problem, when they don't, or when they are not
 * finite, beyond 1e7 mm, or a spacing below 1e-6 mm. */
std::optional<SlicePlane>
MakeSlicePlane(const std::vector<double> & position,
               const std::vector<double> & orientation,
               const std::vector<double> & spacing,
               std::string & problem);

/** The file's name, and for files of several frames the frame's number, from 1. */
std::string
NameOf(const DicomSlice & slice);

/** Four digits of a number, for a sentence. */
std::string
Rounded(double number);

} // namespace rhombic

#endif
