#ifndef rhombicDicomExamination_h
#define rhombicDicomExamination_h

#include "rhombicScan.h"

#include <string>

namespace rhombic
{

/** \class DicomExamination
 * \brief What a DICOM scan says about its values and the region it shows. Both are words of the standard. */
struct DicomExamination
{
  std::string bodyPart; ///< DICOM's term (0018,0015) in upper case: HEAD, ABDOMEN, ...; empty if unknown
  std::string units;    ///< of a PET's values (0054,1001): "Bq/ml", "g/ml", "counts", ...; empty if unknown
};

/** Reads the first file of a scan; both texts are empty for other formats than DICOM. */
DicomExamination
ReadDicomExamination(const Scan & scan);

} // namespace rhombic

#endif
