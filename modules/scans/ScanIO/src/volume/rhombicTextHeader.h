#ifndef rhombicTextHeader_h
#define rhombicTextHeader_h

#include <cstdint>
#include <filesystem>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** A header of lines of text, as NRRD and MetaImage files have. */
struct TextHeader
{
  using Texts = std::map<std::string, std::string>;

  Texts fields;
  Texts keyValues;         ///< NRRD's "key:=value", escapes undone
  std::uintmax_t size = 0; ///< bytes up to the end of the header's last line

  /** The value of the first of the names that is a field; empty when none is. */
  std::string
  Get(const std::vector<std::string> & names) const;
  std::string
  Get(const std::string & name) const
  {
    return this->Get(std::vector<std::string>{ name });
  }

  /** The value of a key; empty when there is none. */
  std::string
  GetValue(const std::string & key) const;
};

/** Reads a text header line by line, up to \a longest bytes. */
class HeaderLines
{
public:
  HeaderLines(std::istream & file, std::uintmax_t longest)
    : m_File(file)
    , m_Longest(longest)
  {}

  /** Reads the next line without its end (LF, or CR and LF). False at the end of the file, and beyond \a longest. */
  bool
  Read(std::string & line);

  /** The number of bytes that were read. */
  std::uintmax_t
  GetSize() const
  {
    return m_Size;
  }

private:
  std::istream & m_File;
  std::uintmax_t m_Longest;
  std::uintmax_t m_Size = 0;
};

/** The numbers of a text, separated by blanks and commas, all in parentheses or none; nothing when the text has
 * anything else. Numbers may be "nan" or "inf". */
std::optional<std::vector<double>>
NumbersOf(const std::string & text);

/** The same for whole numbers from 0 to 2^31 - 1. */
std::optional<std::vector<std::uintmax_t>>
CountsOf(const std::string & text);

/** The number of bytes before the voxels that a header tells: a whole number; 0 for an empty text; -1, for bytes that
 * are not compressed, when the voxels are at the end. Nothing for others. */
std::optional<double>
SkipOf(const std::string & text, bool isDeflated);

/** The sizes of three or four axes (the fourth: several volumes in one file) from a header's texts of their number and
 * the sizes. Throws Failure(Unreadable), naming \a path, when these contradict each other or make no volume. */
std::vector<std::uintmax_t>
AxisSizes(const std::string & dimensionText, const std::string & sizesText, const std::filesystem::path & path);

/** The file of voxels that the header file \a header names. It must be a regular file in the header's folder or below
 * it, so that a header from elsewhere can't name any file of this machine. Throws Failure(Unreadable), also for
 * patterns and lists of files. */
std::filesystem::path
DetachedFile(const std::filesystem::path & header, const std::string & name);

/** A NRRD header; the names of its fields are in lower case and without blanks. */
struct NRRDHeader : TextHeader
{
  /** The key and value of a volume on the face-centered cubic lattice (modules/scans/ScanIO/README.md). */
  static constexpr char LatticeKey[] = "lattice";
  static constexpr char LatticeValue[] = "fcc parity rows";

  bool
  IsLattice() const
  {
    return this->GetValue(LatticeKey) == LatticeValue;
  }
};

/** Throws Failure(Unreadable) when the file is not NRRD, or its header longer than 16 MiB. */
NRRDHeader
ReadNRRDHeader(const std::filesystem::path & path);

/** The name that Rhombic uses for a NRRD sample type: int8, uint8 and so on to uint64, float or double. \a name is any
 * of the names that the NRRD format has for the type, such as "signed short int", in upper or lower case. Empty for
 * other names, "block" among them. */
std::string
CanonicalNRRDType(const std::string & name);

} // namespace rhombic

#endif
