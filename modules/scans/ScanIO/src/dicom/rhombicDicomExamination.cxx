#include "rhombicDicomExamination.h"

#include "rhombicDicomCodes.h"
#include "rhombicDicomHeader.h"
#include "rhombicDicomTags.h"

namespace rhombic
{

DicomExamination
ReadDicomExamination(const Scan & scan)
{
  if (scan.format != "DICOM" || scan.files.empty())
  {
    return {};
  }
  const auto header = ReadDicomHeader(scan.files.front(), { DicomTags::BodyPartExamined, DicomTags::Units });
  return header ? DicomExamination{ BodyPartOf(header->dataSet.GetText(DicomTags::BodyPartExamined)),
                                    UnitsOf(header->dataSet.GetText(DicomTags::Units)) }
                : DicomExamination();
}

} // namespace rhombic
