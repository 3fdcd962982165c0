#ifndef itkNativeScanFileReader_h
#define itkNativeScanFileReader_h

#include "itkScanFileReaderBase.h"

#include "itkAutoPointerDataObjectDecorator.h"

namespace itk
{

/** \class NativeScanFileReader
 * \brief Reads a scan or label map in its own pixel type, which is known when it has been read.
 *
 * For programs that take any pixel type, by `std::visit` of the image of the rhombic::Scan. Others read with
 * ScanFileReader.
 *
 * \ingroup ScanIO
 */
class NativeScanFileReader : public ScanFileReaderBase<ProcessObject>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(NativeScanFileReader);

  using Self = NativeScanFileReader;
  using Superclass = ScanFileReaderBase<ProcessObject>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(NativeScanFileReader, ScanFileReaderBase);

  using OutputType = AutoPointerDataObjectDecorator<rhombic::Scan>;

  /** The scan; Get() is null before Update(). */
  OutputType *
  GetOutput()
  {
    return static_cast<OutputType *>(this->GetPrimaryOutput());
  }

protected:
  NativeScanFileReader();
  ~NativeScanFileReader() override = default;

  DataObject::Pointer
  MakeOutput(DataObjectPointerArraySizeType) override
  {
    return OutputType::New().GetPointer();
  }

  void
  GenerateData() override
  {
    this->GetOutput()->Set(new rhombic::Scan(this->ReadVoxels()));
  }
};

} // namespace itk

#endif
