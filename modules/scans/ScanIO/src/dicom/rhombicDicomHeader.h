#ifndef rhombicDicomHeader_h
#define rhombicDicomHeader_h

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace rhombic
{

/** Group and element of a DICOM tag: 0x00280010 is Rows. */
using DicomTag = std::uint32_t;

/** The elements that Rhombic reads from DICOM files, by their names in the standard (PS3.6): values that describe image
 * and geometry, sequences, and others, which are read if they are asked for. The rest is skipped. */
#define RHOMBIC_DICOM_TAGS(VALUE, SEQUENCE, OTHER)                                                                     \
  VALUE(ImageType, 0x00080008)                                                                                         \
  VALUE(SOPClassUID, 0x00080016)                                                                                       \
  OTHER(SeriesDate, 0x00080021)                                                                                        \
  OTHER(AcquisitionDate, 0x00080022)                                                                                   \
  OTHER(SeriesTime, 0x00080031)                                                                                        \
  OTHER(AcquisitionTime, 0x00080032)                                                                                   \
  VALUE(Modality, 0x00080060)                                                                                          \
  VALUE(FrameType, 0x00089007)                                                                                         \
  VALUE(EchoTime, 0x00180081)                                                                                          \
  VALUE(EchoNumbers, 0x00180086)                                                                                       \
  VALUE(EffectiveEchoTime, 0x00189082)                                                                                 \
  SEQUENCE(MREchoSequence, 0x00189114)                                                                                 \
  SEQUENCE(MRImageFrameTypeSequence, 0x00189226)                                                                       \
  SEQUENCE(CTImageFrameTypeSequence, 0x00189329)                                                                       \
  OTHER(PatientWeight, 0x00101030)                                                                                     \
  OTHER(BodyPartExamined, 0x00180015)                                                                                  \
  VALUE(SliceThickness, 0x00180050)                                                                                    \
  VALUE(SpacingBetweenSlices, 0x00180088)                                                                              \
  OTHER(RadiopharmaceuticalStartTime, 0x00181072)                                                                      \
  OTHER(RadionuclideTotalDose, 0x00181074)                                                                             \
  OTHER(RadionuclideHalfLife, 0x00181075)                                                                              \
  OTHER(RadiopharmaceuticalStartDateTime, 0x00181078)                                                                  \
  VALUE(SeriesInstanceUID, 0x0020000e)                                                                                 \
  VALUE(SeriesNumber, 0x00200011)                                                                                      \
  VALUE(AcquisitionNumber, 0x00200012)                                                                                 \
  VALUE(ImagePositionPatient, 0x00200032)                                                                              \
  VALUE(ImageOrientationPatient, 0x00200037)                                                                           \
  OTHER(FrameOfReferenceUID, 0x00200052)                                                                               \
  VALUE(TemporalPositionIdentifier, 0x00200100)                                                                        \
  VALUE(StackID, 0x00209056)                                                                                           \
  SEQUENCE(FrameContentSequence, 0x00209111)                                                                           \
  SEQUENCE(PlanePositionSequence, 0x00209113)                                                                          \
  SEQUENCE(PlaneOrientationSequence, 0x00209116)                                                                       \
  VALUE(TemporalPositionIndex, 0x00209128)                                                                             \
  VALUE(SamplesPerPixel, 0x00280002)                                                                                   \
  VALUE(PhotometricInterpretation, 0x00280004)                                                                         \
  VALUE(NumberOfFrames, 0x00280008)                                                                                    \
  VALUE(Rows, 0x00280010)                                                                                              \
  VALUE(Columns, 0x00280011)                                                                                           \
  VALUE(PixelSpacing, 0x00280030)                                                                                      \
  OTHER(CorrectedImage, 0x00280051)                                                                                    \
  VALUE(BitsAllocated, 0x00280100)                                                                                     \
  VALUE(BitsStored, 0x00280101)                                                                                        \
  VALUE(HighBit, 0x00280102)                                                                                           \
  VALUE(PixelRepresentation, 0x00280103)                                                                               \
  VALUE(PixelPaddingValue, 0x00280120)                                                                                 \
  VALUE(PixelPaddingRangeLimit, 0x00280121)                                                                            \
  VALUE(RescaleIntercept, 0x00281052)                                                                                  \
  VALUE(RescaleSlope, 0x00281053)                                                                                      \
  SEQUENCE(ModalityLUTSequence, 0x00283000)                                                                            \
  SEQUENCE(PixelMeasuresSequence, 0x00289110)                                                                          \
  SEQUENCE(PixelValueTransformationSequence, 0x00289145)                                                               \
  SEQUENCE(RadiopharmaceuticalInformationSequence, 0x00540016)                                                         \
  OTHER(Units, 0x00541001)                                                                                             \
  OTHER(SUVType, 0x00541006)                                                                                           \
  OTHER(DecayCorrection, 0x00541102)                                                                                   \
  VALUE(SegmentationType, 0x00620001)                                                                                  \
  SEQUENCE(SegmentSequence, 0x00620002)                                                                                \
  VALUE(SegmentNumber, 0x00620004)                                                                                     \
  VALUE(SegmentLabel, 0x00620005)                                                                                      \
  SEQUENCE(SegmentIdentificationSequence, 0x0062000a)                                                                  \
  VALUE(ReferencedSegmentNumber, 0x0062000b)                                                                           \
  VALUE(RecommendedDisplayCIELabValue, 0x0062000d)                                                                     \
  SEQUENCE(SharedFunctionalGroupsSequence, 0x52009229)                                                                 \
  SEQUENCE(PerFrameFunctionalGroupsSequence, 0x52009230)                                                               \
  OTHER(PixelData, 0x7fe00010)

#define RHOMBIC_DICOM_TAG(name, number) constexpr DicomTag name = number;
namespace DicomTags
{
RHOMBIC_DICOM_TAGS(RHOMBIC_DICOM_TAG, RHOMBIC_DICOM_TAG, RHOMBIC_DICOM_TAG)
} // namespace DicomTags
#undef RHOMBIC_DICOM_TAG

/** \class DicomDataSet
 * \brief The elements of a DICOM data set that describe its image and geometry, and none about the patient unless
 * asked. */
class DicomDataSet
{
public:
  bool
  Has(DicomTag tag) const;

  /** The value without padding; empty when absent. */
  std::string
  GetText(DicomTag tag) const;

  /** Decimal numbers separated by backslashes (DS, IS); empty when one of them is no finite number. */
  std::vector<double>
  GetDecimals(DicomTag tag) const;

  /** The first 16-bit number (US). */
  std::optional<std::uint16_t>
  GetShort(DicomTag tag) const;

  /** The first 64-bit real number (FD). */
  std::optional<double>
  GetDouble(DicomTag tag) const;

  /** The 16-bit numbers (US). */
  std::vector<std::uint16_t>
  GetShorts(DicomTag tag) const;

  /** The items of a sequence; none when absent. */
  const std::vector<DicomDataSet> &
  GetItems(DicomTag tag) const;

  /** The first item of a sequence, or an empty data set. */
  const DicomDataSet &
  GetItem(DicomTag tag) const;

  std::map<DicomTag, std::string> values; ///< as stored
  std::map<DicomTag, std::vector<DicomDataSet>> sequences;
  bool isBigEndian = false;
};

/** A part of a file. */
struct ByteRange
{
  std::uintmax_t offset = 0;
  std::uintmax_t size = 0;
};

/** The header of a DICOM file, and the positions of its pixels. */
struct DicomHeader
{
  std::string transferSyntax; ///< UID; empty when the file has none
  DicomDataSet dataSet;
  std::uintmax_t fileSize = 0;
  bool hasPixels = false;
  bool hasWords = false;            ///< whether the pixels are 16-bit words (OW), whatever the size of a pixel
  bool isEncapsulated = false;      ///< whether the pixels are fragments of compressed streams
  ByteRange pixels;                 ///< as in the header: may end beyond the file
  std::vector<ByteRange> fragments; ///< compressed streams of encapsulated pixels, without the table of offsets
  std::string damage;               ///< "its ..." when the header is cut off or damaged
};

/** Reads a file up to its pixels. Nothing when it is not DICOM: it has neither "DICM" after the preamble nor a data set
 * at its beginning, as files older than DICOM.
 *
 * For untrusted files: every length is compared with the file's, sequences are limited to 64 levels and a million
 * items, headers to 16 million elements, and memory to a few times the size of the elements and items that are kept.
 * Throws nothing but std::bad_alloc.
 * \param wanted the elements whose values are kept; empty: those that describe image and geometry */
std::optional<DicomHeader>
ParseDicomHeader(std::istream & file, std::uintmax_t fileSize, const std::set<DicomTag> & wanted = {});

std::optional<DicomHeader>
ReadDicomHeader(const std::filesystem::path & path, const std::set<DicomTag> & wanted = {});

/** \name Header texts without personal data
 * People write names and dates into any field, so only numbers and known words are kept. */
///@{

/** DICOM's codes of modalities, "other" for anything else, empty for an empty text. */
std::string
ModalityOf(const std::string & text);

/** Values of ImageType: values of known words are kept; others become "other-" and four digits of their hash. */
std::string
ImageTypeOf(const std::string & text);

/** Numbers (IS, DS), one or several between backslashes; empty for anything else. */
std::string
NumberTextOf(const std::string & text);

/** A name that may be free text: numbers of up to four digits are kept; others become "other-" and four digits of their
 * hash. */
std::string
NameCodeOf(const std::string & text);

/** DICOM's terms of body parts; empty for anything else. */
std::string
BodyPartOf(const std::string & text);

/** The units of a PET's values in words, by DICOM's terms; empty for anything else. */
std::string
UnitsOf(const std::string & text);

///@}

} // namespace rhombic

#endif
