#ifndef itkScanImageIO_h
#define itkScanImageIO_h

#include "rhombicScanReader.h"

#include "itkImageIOBase.h"

#include <string>

namespace itk
{

/** \class ScanImageIO
 * \brief Lets ImageFileReader read scans and label maps as ScanFileReader does, with all of its checks.
 *
 * After one call of ScanImageIOFactory::RegisterOneFactory(), every ImageFileReader of the program, those in filters
 * and libraries of others among them, reads so:
 * \code
 * itk::ScanImageIOFactory::RegisterOneFactory();
 * const auto reader = itk::ImageFileReader<itk::Image<short, 3>>::New();
 * reader->SetFileName("head/"); // a DICOM or OME-Zarr folder, or a DICOM, NIfTI, NRRD or MetaImage file
 * reader->Update();
 * \endcode
 *
 * It reads what rhombic::OpenScan() reads, and gives the same values and positions, with these differences:
 *
 * - Its component type is the one that a NIfTI, NRRD, MetaImage or OME-Zarr file stores, also CHAR, UINT, LONG, ULONG
 *   and DOUBLE; FLOAT where the file scales its values. That of DICOM is UCHAR, SHORT, USHORT, INT or FLOAT. Where
 *   DICOM headers allow values beyond SHORT (16 stored bits with an intercept), ReadImageInformation() reads the voxels
 *   to know whether there are any, and keeps them for the next Read(). Otherwise it reads headers only.
 * - The reader converts values to its own pixel type as ITK does: with a cast.
 * - Several volumes in a NIfTI, NRRD or MetaImage file, pictures, vectors, complex numbers, colours, texts and kinds of
 *   DICOM images that OpenScan() does not read are left to ITK: CanReadFile() is false.
 * - A DICOM folder is a series, and a DICOM file is that file alone, also one slice: ImageSeriesReader, which names the
 *   files, gives the image that it gives with GDCMImageIO. Tags are GDCMImageIO's: `SetImageIO()` brings them back.
 * - Damaged files are not left to ITK: ReadImageInformation() or Read() throw.
 * - Files of this module's formats without compression are read in part: CanStreamRead() is true for them.
 * - Choices are ScanFileReader's: it reads slices at uneven distances and with gaps, which no ITK image holds, one of
 *   several series, and Analyze 7.5 files.
 *
 * Directions may be sheared. The MetaDataDictionary holds the texts that ScanFileReader documents, and nothing about
 * the patient. It writes no files.
 *
 * Errors are exceptions of class rhombic::Failure, which is an ExceptionObject, with what is wrong with which file, and
 * what to try. CanReadFile() throws nothing but std::bad_alloc.
 *
 * Thread safety: that of any ImageIOBase: one object for each thread.
 *
 * \ingroup ScanIO
 */
class ScanImageIO : public ImageIOBase
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ScanImageIO);

  using Self = ScanImageIO;
  using Superclass = ImageIOBase;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(ScanImageIO, ImageIOBase);

  /** Whether a folder or file holds a scan, also one that is damaged or has to be refused. Reads its headers, which
   * ReadImageInformation() of the same name takes over. */
  bool
  CanReadFile(const char * fileName) override;

  /** Whether Read() of a region takes only its share of the file. Known after ReadImageInformation(). */
  bool
  CanStreamRead() override;

  void
  ReadImageInformation() override;

  void
  Read(void * buffer) override;

  /** The requested region if CanStreamRead() and UseStreamedReading, else the whole image. Throws rhombic::Failure
   * (Memory) when its voxels would take more than half of the free memory. */
  ImageIORegion
  GenerateStreamableReadRegionFromRequestedRegion(const ImageIORegion & requested) const override;

  /** False: ITK's own classes write. */
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
  ScanImageIO();
  ~ScanImageIO() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  bool
  ReadsInPart() const
  {
    return m_File.native && m_File.native->areReadInPart;
  }

  std::string m_OpenedFileName; ///< of m_OpenedFile; empty when there is none
  rhombic::UnreadScan m_OpenedFile;
  rhombic::UnreadScan m_File;
  rhombic::Scan m_EarlyScan; ///< read with the headers
};

} // namespace itk

#endif
