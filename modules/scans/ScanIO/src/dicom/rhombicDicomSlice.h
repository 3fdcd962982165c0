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

/** The position and axes of a slice, in LPS millimetres. */
struct SlicePlane
{
  itk::Point<double, 3> position;    ///< centre of the first pixel
  itk::Vector<double, 3> columnStep; ///< from a pixel to the next in its row
  itk::Vector<double, 3> rowStep;    ///< from a row to the next
};

/** The unit vector perpendicular to a slice. */
itk::Vector<double, 3>
NormalOf(const SlicePlane & plane);

/** The compression of the pixels in a DICOM transfer syntax. */
enum class PixelCodec
{
  None,
  JPEG,
  JPEGLS,
  JPEG2000,
  RunLength,
  Unsupported
};

/** A transfer syntax of DICOM (PS3.5, annex A). */
struct TransferSyntax
{
  std::string name; ///< in a few words
  PixelCodec codec = PixelCodec::Unsupported;
  bool isLossy = false; ///< whether values may differ from the original ones
};

/** An empty UID is taken for a syntax without compression. */
TransferSyntax
FindTransferSyntax(const std::string & uid);

/** The storage of the pixels of a DICOM file. */
struct DicomPixelFormat
{
  std::string transferSyntax;    ///< UID
  unsigned int swappedBytes = 1; ///< bytes of a word in the other byte order; 1 when no bytes are swapped
  bool isEncapsulated = false;
  unsigned int columns = 0;
  unsigned int rows = 0;
  std::size_t frames = 1;
  unsigned int bitsAllocated = 0; ///< 1, 8, 16 or 32
  unsigned int bitsStored = 0;
  unsigned int highBit = 0;
  bool isSigned = false;

  /** The range of stored values that mean "outside the scanner's view". */
  std::optional<std::pair<std::int64_t, std::int64_t>> padding;

  /** Whether a stored pixel is padding; \a padding must be set. Padding may use bits beyond bitsStored, so all bits are
   * compared. */
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
  std::string pixelDamage;                          ///< "it ..." when the pixels are not all there
  std::shared_ptr<const DicomDataSet> segmentation; ///< all elements that are kept, of a SEG; null for other files
};

/** One frame of a DICOM file, from its header. */
struct DicomSlice
{
  /** The content of a file. */
  enum class Kind
  {
    Scan,
    Segmentation, ///< a DICOM SEG object that can be read
    NoImage       ///< a report, a plan, or damaged
  };

  /** Properties that may separate slices at the same position, in the order in which they are tried: type of the image,
   * echo, time, stack, acquisition. */
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
  bool isScaled = false;           ///< whether the header has slope or intercept
  double step = 1;                 ///< SpacingBetweenSlices of a plain MR image in mm; 1 when unknown
  std::optional<SlicePlane> plane; ///< absent when the header has no usable one
  std::string planeProblem;        ///< why it is absent
  std::string refusal;             ///< why it can't be a slice of a volume ("it is ..."); empty if it can
  bool isOther = false; ///< whether it is intact, but a kind of image that is not read, or no slice of a patient
};

/** The slices of a file, one for each frame; a single one when the header does not place its frames. Nothing when the
 * file is not DICOM. */
std::vector<DicomSlice>
ReadDicomSlices(const std::filesystem::path & path);

/** The plane of a position, orientation and spacing. Nothing, and the reason in \a problem, when numbers are missing,
 * not finite or beyond 1e7 mm, a spacing is below 1e-6 mm, or the axes are not perpendicular unit vectors. */
std::optional<SlicePlane>
MakeSlicePlane(const std::vector<double> & position,
               const std::vector<double> & orientation,
               const std::vector<double> & spacing,
               std::string & problem);

/** The file's name and, for files of several frames, the frame's number from 1. */
std::string
NameOf(const DicomSlice & slice);

} // namespace rhombic

#endif
