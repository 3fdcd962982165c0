#ifndef rhombicDicomPreamble_h
#define rhombicDicomPreamble_h

#include <filesystem>
#include <string>

namespace rhombic
{

/** What the first bytes of a file say. */
struct DicomPreamble
{
  bool isDicom = false;
  std::string transferSyntax; ///< UID; empty when not given
};

/** Looks for "DICM" and walks the file meta information behind it, which GDCM aborts on when it is damaged. Files of
 * the time before DICOM had a preamble count as not DICOM. */
DicomPreamble
ReadDicomPreamble(const std::filesystem::path & path);

} // namespace rhombic

#endif
