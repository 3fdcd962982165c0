#include "itkScanFileReader.h"

#include "itkNativeScanFileReader.h"

namespace itk
{

RHOMBIC_INSTANTIATE(template class ScanFileReader, rhombic::CartesianImage);

NativeScanFileReader::NativeScanFileReader()
{
  this->SetNthOutput(0, this->MakeOutput(0));
}

} // namespace itk
