#ifndef rhombicDicomHeader_h
#define rhombicDicomHeader_h

#include <cstddef>
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

} // namespace rhombic

#endif
