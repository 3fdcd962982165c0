#ifndef rhombicPatientMask_h
#define rhombicPatientMask_h

#include "rhombicCoarseScan.h"

#include <string>
#include <vector>

namespace rhombic
{

/** The blocks of the patient in a coarse scan. */
struct PatientMask
{
  MaskImage::Pointer tissue;      ///< blocks that are half or more at or above the threshold of tissue
  MaskImage::Pointer patient;     ///< blocks of the patient; null when there is no body
  std::vector<std::string> notes; ///< parts that were kept in doubt
};

PatientMask
FindPatient(const CoarseScan & coarse);

} // namespace rhombic

#endif
