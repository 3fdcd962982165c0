#ifndef itkScanFileReader_h
#define itkScanFileReader_h

#include "itkScanFileReaderBase.h"

#include "itkImage.h"
#include "itkMetaDataDictionary.h"

namespace itk
{

/** \class ScanFileReader
 * \brief Reads a scan or label map: a folder of DICOM slices, a DICOM file of many frames, NIfTI, NRRD, MetaImage.
 *
 * From a folder to a surface, every slice at its true position:
 * \code
 * const auto reader = itk::ScanFileReader<itk::Image<short, 3>>::New();
 * reader->SetFileName("head/");
 * reader->AcceptUnevenOn();
 * reader->UpdateOutputInformation();
 * const auto lattice = itk::CartesianToFCCImageFilter<itk::Image<short, 3>>::New();
 * lattice->SetInput(reader->GetOutput()); // or that of any filter of ITK behind it
 * lattice->SetScan(reader->GetScan());
 * const auto surface = itk::FCCIsosurfaceFilter<itk::FCCImage<short>>::New();
 * surface->SetInput(lattice->GetOutput());
 * surface->SetIsovalue(250.5);
 * surface->Update();
 * \endcode
 *
 * UpdateOutputInformation() reads headers only: then size, spacing, origin and direction of the output,
 * GetComponentType() and GetScan() are known. Update() reads the voxels, all at once: the output can't be streamed.
 *
 * Values are the true ones, HU for CT; rhombic::OpenScan() tells how they are found, and the position too. They are
 * converted to the output's pixel type, which must be a number. A value that the type does not hold exactly, such as
 * 40000 or 0.5 for short, is an error that names the value: float holds all that scans hold.
 *
 * The output is in LPS millimetres. A tilted gantry or sheared affine makes its direction sheared: its axes are then
 * not perpendicular, which all of ITK's functions of points and indices respect, and its filters keep. Unevenly spaced
 * slices, which no ITK image holds, are refused unless AcceptUneven is on. The output's third axis then leads from the
 * first to the last, GetScan() knows their true positions, and so does CartesianToFCCImageFilter by
 * `SetScan(reader->GetScan())`. A SlicePlacement in the output's MetaDataDictionary holds them too (ITK's writers say
 * that they leave it out), from which the lattice filter knows a scan that came without SetScan(): directly behind the
 * reader it uses them, behind filters of ITK, which drop the dictionary, it refuses the image.
 *
 * The MetaDataDictionary holds these texts besides, which ITK's writers may put into files: ScanFormat ("DICOM", ...),
 * ScanModality, ScanEncoding, ScanScaling, ScanSeries (the id of the DICOM series), ScanFrame, ScanTiltDegrees,
 * ScanIsOriented. It holds nothing about the patient.
 *
 * Errors are exceptions of class rhombic::Failure, which is an ExceptionObject, with one sentence: what is wrong with
 * which file, and what to try.
 *
 * Overridden pipeline methods: GenerateOutputInformation() (reads the headers), EnlargeOutputRequestedRegion() (the
 * whole volume), GenerateData() (reads the voxels).
 *
 * Thread safety: that of any process object.
 *
 * \ingroup ScanIO
 */
template <typename TOutputImage>
class ITK_TEMPLATE_EXPORT ScanFileReader : public ScanFileReaderBase<ImageSource<TOutputImage>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ScanFileReader);

  using Self = ScanFileReader;
  using Superclass = ScanFileReaderBase<ImageSource<TOutputImage>>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(ScanFileReader, ScanFileReaderBase);

  using OutputPixelType = typename TOutputImage::PixelType;

  static_assert(TOutputImage::ImageDimension == 3, "Scans are three-dimensional");
  static_assert(std::is_arithmetic<OutputPixelType>::value, "Voxels are single numbers");

protected:
  ScanFileReader() = default;
  ~ScanFileReader() override = default;

  void
  GenerateOutputInformation() override;

  void
  EnlargeOutputRequestedRegion(DataObject * output) override;

  void
  GenerateData() override;

  /** Called with the scan before it is converted. */
  virtual void
  Inspect(const rhombic::Scan &)
  {}

private:
  /** Gives the output a MetaDataDictionary with what is known of the scan. */
  void
  DescribeOutput(const MetaDataDictionary & placement);

  /** Gives the output the voxels, converted if need be. */
  template <typename TPixel>
  void
  TakeVoxels(Image<TPixel, 3> & voxels);

  rhombic::Scan m_EarlyScan; ///< read with the headers
};

} // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkScanFileReader.hxx"
#endif

// Compiled once, in the library, for the pixel types of scans.
namespace itk
{
RHOMBIC_INSTANTIATE(extern template class ScanFileReader, rhombic::CartesianImage);
} // namespace itk

#endif
