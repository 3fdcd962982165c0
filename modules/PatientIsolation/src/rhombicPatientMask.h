#ifndef rhombicPatientMask_h
#define rhombicPatientMask_h

#include "rhombicCoarseScan.h"

#include <string>
#include <vector>

namespace rhombic
{

/** Where the patient is in a coarse scan. */
struct PatientMask
{
  MaskImage::Pointer tissue;      ///< blocks that are half or more at or above the threshold of tissue
  MaskImage::Pointer patient;     ///< those of them that are the patient's; null when there is no body
  std::vector<std::string> notes; ///< what was kept for doubt, a sentence each
};

PatientMask
FindPatient(const CoarseScan & coarse);

} // namespace rhombic

#endif
