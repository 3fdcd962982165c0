#include "itkScanImageIO.h"

#include "itkScanImageIOFactory.h"
#include "rhombicMemoryBudget.h"
#include "rhombicVolumeRefusal.h"

#include "itkMetaDataObject.h"
#include "itkVersion.h"

#include <algorithm>
#include <utility>

namespace itk
{
namespace
{

/** Opens a scan that one image of single numbers holds, or a single slice of one. */
rhombic::UnreadScan
OpenImage(const std::string & fileName)
{
  rhombic::ScanReadOptions options;
  options.onSingleSlice = rhombic::ScanReadOptions::Policy::Accept;
  rhombic::UnreadScan file = rhombic::OpenScan(fileName, options);
  std::error_code error;
  const bool isVolumeFile =
    !rhombic::VolumeFormatOf(fileName).empty() && !std::filesystem::is_directory(fileName, error);
  rhombic::RefuseOtherIf(isVolumeFile && !file.native,
                         fileName,
                         "it holds several volumes; read them with itk::ScanFileReader or rhombic::ReadLabelMap()");
  return file;
}

/** Calls \a read. Tells where the choices are that an exception's sentence offers. */
template <typename TRead>
auto
ReadOrAdvise(const TRead & read)
{
  try
  {
    return read();
  }
  catch (const rhombic::Failure & failure)
  {
    const std::string sentence = failure.GetDescription();
    if (sentence.find("ScanReadOptions") == std::string::npos)
    {
      throw;
    }
    throw rhombic::Failure(failure.GetKind(),
                           sentence + " itk::ImageFileReader has no such options: use itk::ScanFileReader.");
  }
}

/** A region along three axes: without further ones, and at the beginning of those that it lacks. */
ImageRegion<3>
InThreeDimensions(const ImageIORegion & region)
{
  ImageRegion<3> volume({ { 0, 0, 0 } }, { { 1, 1, 1 } });
  for (unsigned int axis = 0; axis < std::min(3U, region.GetImageDimension()); ++axis)
  {
    volume.SetIndex(axis, region.GetIndex(axis));
    volume.SetSize(axis, region.GetSize(axis));
  }
  return volume;
}

template <typename TPixel>
void
CopyRegion(const Image<TPixel, 3> & image, const ImageRegion<3> & region, TPixel * buffer)
{
  const Size<3> & size = region.GetSize();
  for (SizeValueType row = 0; row < size[1] * size[2]; ++row)
  {
    Index<3> index = region.GetIndex();
    index[1] += static_cast<IndexValueType>(row % size[1]);
    index[2] += static_cast<IndexValueType>(row / size[1]);
    buffer = std::copy_n(image.GetBufferPointer() + image.ComputeOffset(index), size[0], buffer);
  }
}

} // namespace

ScanImageIO::ScanImageIO()
{
  for (const char * const extension :
       { ".dcm", ".nii", ".nii.gz", ".hdr", ".img", ".hdr.gz", ".img.gz", ".nrrd", ".nhdr", ".mha", ".mhd" })
  {
    this->AddSupportedReadExtension(extension);
  }
}

bool
ScanImageIO::CanReadFile(const char * fileName)
{
  m_OpenedFileName.clear();
  try
  {
    m_OpenedFile = OpenImage(fileName);
    m_OpenedFileName = fileName;
    return true;
  }
  catch (const rhombic::OtherImage &)
  {
    return false;
  }
  catch (const rhombic::Failure & failure)
  {
    return failure.GetKind() != rhombic::FailureKind::NotFound;
  }
}

bool
ScanImageIO::CanStreamRead()
{
  return this->ReadsInPart();
}

void
ScanImageIO::ReadImageInformation()
{
  m_EarlyScan = {};
  m_File = {};
  const bool isOpened = !m_OpenedFileName.empty() && m_OpenedFileName == m_FileName;
  m_OpenedFileName.clear();
  m_File = isOpened ? std::exchange(m_OpenedFile, {}) : ReadOrAdvise([this] { return OpenImage(m_FileName); });
  if (!m_File.isTypeCertain)
  {
    m_EarlyScan = ReadOrAdvise([this] { return rhombic::ReadVoxels(m_File); });
  }
  const rhombic::Scan & scan = m_File.isTypeCertain ? m_File.scan : m_EarlyScan;

  const ImageBase<3> & geometry = rhombic::GeometryOf(scan.image);
  this->SetNumberOfDimensions(3);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    this->SetDimensions(axis, geometry.GetLargestPossibleRegion().GetSize(axis));
    this->SetOrigin(axis, geometry.GetOrigin()[axis]);
    this->SetSpacing(axis, geometry.GetSpacing()[axis]);
    this->SetDirection(axis, geometry.GetDirection().GetVnlMatrix().get_column(axis).as_vector());
  }
  this->SetPixelType(IOPixelEnum::SCALAR);
  this->SetNumberOfComponents(1);
  this->SetComponentType(m_File.native ? m_File.native->type : rhombic::ComponentTypeOf(scan.image));
  this->SetFileTypeToBinary();

  MetaDataDictionary dictionary;
  for (const auto & [key, text] : rhombic::SummarizeScan(scan))
  {
    EncapsulateMetaData<std::string>(dictionary, key, text);
  }
  this->SetMetaDataDictionary(dictionary);
}

ImageIORegion
ScanImageIO::GenerateStreamableReadRegionFromRequestedRegion(const ImageIORegion & requested) const
{
  const bool isInPart = this->ReadsInPart() && m_UseStreamedReading;
  const ImageIORegion region =
    isInPart ? requested : Superclass::GenerateStreamableReadRegionFromRequestedRegion(requested);
  ReadOrAdvise([&] {
    const auto bytes = static_cast<std::uintmax_t>(region.GetNumberOfPixels()) * this->GetComponentSize();
    rhombic::RequireMemory(bytes, 0, "Reading " + m_FileName);
  });
  return region;
}

void
ScanImageIO::Read(void * buffer)
{
  const ImageRegion<3> region = InThreeDimensions(m_IORegion);
  if (m_File.scan.format.empty())
  {
    itkExceptionMacro("ReadImageInformation() must be called before Read()");
  }
  const ImageRegion<3> whole = rhombic::GeometryOf(m_File.scan.image).GetLargestPossibleRegion();
  if (region.GetNumberOfPixels() > 0 && !whole.IsInside(region))
  {
    itkExceptionMacro("The region to read is not inside the image: " << region);
  }
  if (m_File.native)
  {
    m_File.native->read(region, buffer);
    return;
  }
  rhombic::Scan scan = std::exchange(m_EarlyScan, {});
  if (scan.format.empty())
  {
    scan = ReadOrAdvise([this] { return rhombic::ReadVoxels(m_File); });
  }
  rhombic::RefuseVolumeIf(rhombic::ComponentTypeOf(scan.image) != m_ComponentType ||
                            rhombic::GeometryOf(scan.image).GetLargestPossibleRegion() != whole,
                          m_FileName,
                          "its files changed while they were read; read it again");
  rhombic::FailIf(!scan.furtherLayers.empty(),
                  rhombic::FailureKind::Usage,
                  "Cannot read " + m_FileName +
                    " as one image: its labels overlap; read its layers with rhombic::ReadLabelMap().");
  std::visit(
    [&](const auto & image) {
      using Pixel = typename std::decay_t<decltype(*image)>::PixelType;
      CopyRegion(*image, region, static_cast<Pixel *>(buffer));
    },
    scan.image);
}

void
ScanImageIO::WriteImageInformation()
{
  itkExceptionMacro("ScanImageIO writes no files");
}

void
ScanImageIO::Write(const void *)
{
  itkExceptionMacro("ScanImageIO writes no files");
}

void
ScanImageIO::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "ReadsInPart: " << this->ReadsInPart() << std::endl;
}

ScanImageIOFactory::ScanImageIOFactory()
{
  this->RegisterOverride(
    "itkImageIOBase", "itkScanImageIO", "Rhombic's reader of scans", true, CreateObjectFunction<ScanImageIO>::New());
}

const char *
ScanImageIOFactory::GetITKSourceVersion() const
{
  return ITK_SOURCE_VERSION;
}

const char *
ScanImageIOFactory::GetDescription() const
{
  return "Makes ScanImageIO, which reads DICOM, NIfTI, NRRD, MetaImage and OME-Zarr with Rhombic's checks";
}

void
ScanImageIOFactory::RegisterOneFactory()
{
  const Pointer factory = Self::New();
  for (ObjectFactoryBase * const other : ObjectFactoryBase::GetRegisteredFactories())
  {
    if (dynamic_cast<Self *>(other) != nullptr)
    {
      ObjectFactoryBase::UnRegisterFactory(other);
    }
  }
  ObjectFactoryBase::RegisterFactory(factory, InsertionPositionEnum::INSERT_AT_FRONT);
}

} // namespace itk
