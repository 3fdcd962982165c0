#ifndef itkOMEZarrImageIO_h
#define itkOMEZarrImageIO_h

#include "rhombicOMEZarrImage.h"

#include "itkImageIOBase.h"

namespace itk
{

/** \class OMEZarrImageIO
 * \brief Lets ImageFileReader read a volume from a folder of OME-Zarr 0.4, in parts.
 *
 * \code
 * itk::OMEZarrImageIOFactory::RegisterOneFactory();
 * const auto reader = itk::ImageFileReader<itk::Image<unsigned short, 3>>::New();
 * reader->SetFileName("brain.ome.zarr");
 * reader->Update();
 * \endcode
 *
 * A level, a frame or the size of voxels is chosen with an object of this class and ImageFileReader::SetImageIO().
 * Values are those that are stored, in the type that is stored; positions are in LPS mm, as rhombic::OMEZarrImage
 * tells. Read() of a region takes the chunks that the region touches, on all threads. It writes no files.
 *
 * Errors are exceptions of class rhombic::Failure, which is an ExceptionObject, with what is wrong with which file, and
 * what to try.
 *
 * Thread safety: that of any ImageIOBase: one object for each thread.
 *
 * \ingroup OMEZarr
 */
class OMEZarrImageIO : public ImageIOBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(OMEZarrImageIO);

  using Self = OMEZarrImageIO;
  using Superclass = ImageIOBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(OMEZarrImageIO, ImageIOBase);

  /** The level of the pyramid, from 0, the finest and the default. */
  ///@{
  itkSetMacro(Level, SizeValueType);
  itkGetConstMacro(Level, SizeValueType);
  ///@}

  /** The volume of an image that holds several, such as times and channels; from 0, the default. The last axis of the
   * array in front of space counts fastest. */
  ///@{
  itkSetMacro(Frame, SizeValueType);
  itkGetConstMacro(Frame, SizeValueType);
  ///@}

  using VoxelSizeType = Vector<double, 3>;

  /** The size of a voxel along x, y and z in mm, for images that do not tell it. 0, the default: not given. */
  ///@{
  itkSetMacro(VoxelSize, VoxelSizeType);
  itkGetConstMacro(VoxelSize, VoxelSizeType);
  ///@}

  /** Whether a folder is one of Zarr version 2 or 3, also one that has to be refused. */
  bool
  CanReadFile(const char * fileName) override;

  /** True. */
  bool
  CanStreamRead() override
  {
    return true;
  }

  void
  ReadImageInformation() override;

  void
  Read(void * buffer) override;

  /** The requested region if UseStreamedReading, else the whole image. */
  ImageIORegion
  GenerateStreamableReadRegionFromRequestedRegion(const ImageIORegion & requested) const override;

  /** False. */
  bool
  CanWriteFile(const char *) override
  {
    return false;
  }

  /** Throw an exception. */
  ///@{
  void
  WriteImageInformation() override;

  void
  Write(const void * buffer) override;
  ///@}

protected:
  OMEZarrImageIO();
  ~OMEZarrImageIO() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  SizeValueType m_Level = 0;
  SizeValueType m_Frame = 0;
  VoxelSizeType m_VoxelSize;
  rhombic::OMEZarrImage m_Image;
};

} // namespace itk

#endif
