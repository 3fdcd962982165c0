#ifndef rhombicNRRDHeader_h
#define rhombicNRRDHeader_h

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace rhombic
{

/** The lines of a NRRD header. */
struct NRRDHeader
{
  /** The key and value of a volume on the face-centered cubic lattice (modules/scans/ScanIO/README.md). */
  static constexpr char LatticeKey[] = "lattice";
  static constexpr char LatticeValue[] = "fcc parity rows";

  std::map<std::string, std::string> fields;    ///< "field: value", names in lower case and without blanks
  std::map<std::string, std::string> keyValues; ///< "key:=value", escapes undone
  std::uintmax_t size = 0;                      ///< bytes up to the end of the empty line

  /** The value of a field; empty when there is none. */
  std::string
  Get(const std::string & field) const;

  /** The value of a key; empty when there is none. */
  std::string
  GetValue(const std::string & key) const;

  bool
  IsLattice() const
  {
    return this->GetValue(LatticeKey) == LatticeValue;
  }
};

/** Throws Failure(Unreadable) when the file is not NRRD, or its header longer than 16 MiB. */
NRRDHeader
ReadNRRDHeader(const std::filesystem::path & path);

/** The key/value pairs of a NRRD file, as Slicer describes segments. Throws as ReadNRRDHeader(). */
std::map<std::string, std::string>
ReadNRRDKeyValues(const std::filesystem::path & path);

/** The name that Rhombic uses for a NRRD sample type: int8, uint8 and so on to uint64, float or double. \a name is any
 * of the names that the NRRD format has for the type, such as "signed short int", in upper or lower case. Empty for
 * other names, "block" among them. */
std::string
CanonicalNRRDType(const std::string & name);

} // namespace rhombic

#endif
