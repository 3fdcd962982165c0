#include "itkOMEZarrImageIO.h"

#include "itkOMEZarrImageIOFactory.h"
#include "rhombicFailure.h"

#include "itkVersion.h"

#include <algorithm>

namespace itk
{
namespace
{

/** A region along three axes: without further ones, and at the beginning of those that it lacks. */
ImageRegion<3>
VolumeRegionOf(const ImageIORegion & region)
{
  ImageRegion<3> volume({ { 0, 0, 0 } }, { { 1, 1, 1 } });
  for (unsigned int axis = 0; axis < std::min(3U, region.GetImageDimension()); ++axis)
  {
    volume.SetIndex(axis, region.GetIndex(axis));
    volume.SetSize(axis, region.GetSize(axis));
  }
  return volume;
}

} // namespace

OMEZarrImageIO::OMEZarrImageIO()
{
  m_VoxelSize.Fill(0);
  this->AddSupportedReadExtension(".zarr");
}

bool
OMEZarrImageIO::CanReadFile(const char * fileName)
{
  return rhombic::IsZarr(fileName);
}

void
OMEZarrImageIO::ReadImageInformation()
{
  m_Image = {};
  rhombic::OMEZarrOptions options;
  options.level = m_Level;
  if (m_VoxelSize != VoxelSizeType(0.0))
  {
    options.voxelSize = { m_VoxelSize[0], m_VoxelSize[1], m_VoxelSize[2] };
  }
  const rhombic::OMEZarrImage image(m_FileName, options);
  if (m_Frame >= image.GetNumberOfFrames())
  {
    throw rhombic::Failure(rhombic::FailureKind::Usage,
                           "Cannot read volume " + std::to_string(m_Frame) + " of " + m_FileName + ": it holds " +
                             std::to_string(image.GetNumberOfFrames()) + ", counted from 0; choose another frame.");
  }
  this->SetNumberOfDimensions(3);
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const Vector<double, 3> & step = image.GetSteps()[axis];
    const double spacing = step.GetNorm();
    const Vector<double, 3> direction = step / spacing;
    this->SetDimensions(axis, image.GetSize()[axis]);
    this->SetOrigin(axis, image.GetOrigin()[axis]);
    this->SetSpacing(axis, spacing);
    this->SetDirection(axis, { direction[0], direction[1], direction[2] });
  }
  this->SetPixelType(IOPixelEnum::SCALAR);
  this->SetNumberOfComponents(1);
  this->SetComponentType(
    std::visit([](auto value) { return ImageIOBase::MapPixelType<decltype(value)>::CType; }, image.GetType()));
  this->SetFileTypeToBinary();
  m_Image = image;
}

void
OMEZarrImageIO::Read(void * buffer)
{
  const ImageRegion<3> region = VolumeRegionOf(m_IORegion);
  const ImageRegion<3> whole = m_Image.GetSize();
  if (whole.GetNumberOfPixels() == 0)
  {
    itkExceptionMacro("ReadImageInformation() must be called before Read()");
  }
  if (region.GetNumberOfPixels() > 0 && !whole.IsInside(region))
  {
    itkExceptionMacro("The region to read is not inside the image: " << region);
  }
  m_Image.Read(m_Frame, region, buffer);
}

ImageIORegion
OMEZarrImageIO::GenerateStreamableReadRegionFromRequestedRegion(const ImageIORegion & requested) const
{
  return m_UseStreamedReading ? requested : Superclass::GenerateStreamableReadRegionFromRequestedRegion(requested);
}

void
OMEZarrImageIO::WriteImageInformation()
{
  itkExceptionMacro("OMEZarrImageIO writes no files");
}

void
OMEZarrImageIO::Write(const void *)
{
  itkExceptionMacro("OMEZarrImageIO writes no files");
}

void
OMEZarrImageIO::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Level: " << m_Level << std::endl;
  os << indent << "Frame: " << m_Frame << std::endl;
  os << indent << "VoxelSize: " << m_VoxelSize << std::endl;
}

OMEZarrImageIOFactory::OMEZarrImageIOFactory()
{
  this->RegisterOverride("itkImageIOBase",
                         "itkOMEZarrImageIO",
                         "Rhombic's reader of OME-Zarr",
                         true,
                         CreateObjectFunction<OMEZarrImageIO>::New());
}

const char *
OMEZarrImageIOFactory::GetITKSourceVersion() const
{
  return ITK_SOURCE_VERSION;
}

const char *
OMEZarrImageIOFactory::GetDescription() const
{
  return "Makes OMEZarrImageIO, which reads volumes in folders of OME-Zarr 0.4";
}

void
OMEZarrImageIOFactory::RegisterOneFactory()
{
  const auto factories = ObjectFactoryBase::GetRegisteredFactories();
  const auto isOne = [](ObjectFactoryBase * other) { return dynamic_cast<Self *>(other) != nullptr; };
  if (std::none_of(factories.begin(), factories.end(), isOne))
  {
    const Pointer factory = Self::New();
    ObjectFactoryBase::RegisterFactory(factory);
  }
}

} // namespace itk
