#ifndef itkScanFileReaderBase_h
#define itkScanFileReaderBase_h

#include "rhombicScanReader.h"

#include "itkImageSource.h"
#include "itkWorkProgress.h"

#include <optional>
#include <string>

namespace itk
{

/** \class ScanFileReaderBase
 * \brief What the readers of scans have in common: what is read, and how.
 *
 * Voxels that only a library can unpack are unpacked in child processes with limits, so that damaged files can't end
 * this process; their program must be installed (see rhombic::SandboxRun).
 *
 * \tparam TSource the process object that a reader is: ImageSource<TOutputImage> or ProcessObject
 *
 * Overridden pipeline methods: GenerateOutputInformation() (reads the headers).
 *
 * \ingroup ScanIO
 */
template <typename TSource>
class ITK_TEMPLATE_EXPORT ScanFileReaderBase : public TSource
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ScanFileReaderBase);

  using Self = ScanFileReaderBase;
  using Superclass = TSource;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkTypeMacro(ScanFileReaderBase, TSource);

  using OptionsType = rhombic::ScanReadOptions;

  /** A folder of DICOM slices, searched with its subfolders, or a file: DICOM that holds a volume, NIfTI, NRRD,
   * MetaImage. */
  itkSetStringMacro(FileName);
  itkGetStringMacro(FileName);

  /** The DICOM series of a folder: its place in rhombic::ListSeries() from 1, its SeriesNumber, or its UID. Default
   * empty: the only one, or the one that has at least twice as many slices as any other. */
  void
  SetSeries(const std::string & series)
  {
    this->Assign(m_Options.series, series);
  }
  const std::string &
  GetSeries() const
  {
    return m_Options.series;
  }

  /** The volume of a file that holds several, from 0. Default unset: such files are refused. */
  void
  SetFrame(SizeValueType frame)
  {
    this->Assign(m_Options.frame, std::optional<std::size_t>(frame));
  }
  const std::optional<std::size_t> &
  GetFrame() const
  {
    return m_Options.frame;
  }

  /** Whether a stack with missing slices is read, with the other slices at their true positions; ScanFileReader needs
   * AcceptUneven, too. Default false: it is refused. When on, UpdateOutputInformation() reads the voxels, too, to leave
   * out the slices of damaged files. */
  void
  SetAcceptGaps(bool accept)
  {
    using Policy = OptionsType::Policy;
    this->Assign(m_Options.onGap, accept ? Policy::Accept : Policy::Refuse);
  }
  bool
  GetAcceptGaps() const
  {
    return m_Options.onGap == OptionsType::Policy::Accept;
  }
  itkBooleanMacro(AcceptGaps);

  /** Whether slices that are tilted, and sheared volumes, are read, with a sheared direction. Default true; otherwise
   * they are refused. */
  void
  SetAcceptTilted(bool accept)
  {
    using Policy = OptionsType::Policy;
    this->Assign(m_Options.onTilted, accept ? Policy::Accept : Policy::Refuse);
  }
  bool
  GetAcceptTilted() const
  {
    return m_Options.onTilted == OptionsType::Policy::Accept;
  }
  itkBooleanMacro(AcceptTilted);

  /** Whether slices that are unevenly spaced are read, and by ScanFileReader the slices that AcceptGaps leaves. Default
   * false: they are refused, as no ITK image holds their places. Give the scan to the filter to the lattice then, which
   * also works behind filters of ITK: `lattice->SetScan(reader->GetScan())`. */
  void
  SetAcceptUneven(bool accept)
  {
    using Policy = OptionsType::Policy;
    this->Assign(m_Options.onUneven, accept ? Policy::Accept : Policy::Refuse);
  }
  bool
  GetAcceptUneven() const
  {
    return m_Options.onUneven == OptionsType::Policy::Accept;
  }
  itkBooleanMacro(AcceptUneven);

  /** All of these choices and some more at once. Its progress is not called: observe ProgressEvent. */
  void
  SetOptions(const OptionsType & options)
  {
    m_Options = options;
    this->Modified();
  }
  const OptionsType &
  GetOptions() const
  {
    return m_Options;
  }

  /** What is known of the scan: format, modality, series, geometry report, scaling, notes. Nothing about the patient,
   * but fileNotes may name files. After UpdateOutputInformation() from headers, after Update() complete. Its image has
   * size and position, but no voxels. */
  const rhombic::Scan &
  GetScan() const
  {
    return m_Scan;
  }

  /** The type of the scan's own values: UCHAR, SHORT, USHORT, INT or FLOAT (see rhombic::OpenScan()). Before
   * UpdateOutputInformation() UNKNOWNCOMPONENTTYPE. Values that turn out to be beyond SHORT make it USHORT or INT in
   * Update(), and those beyond INT make it FLOAT. */
  IOComponentEnum
  GetComponentType() const
  {
    return rhombic::ComponentTypeOf(m_Scan.image);
  }

protected:
  ScanFileReaderBase() = default;
  ~ScanFileReaderBase() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "FileName: " << m_FileName << std::endl;
    os << indent << "Series: " << m_Options.series << std::endl;
    os << indent << "AcceptGaps: " << this->GetAcceptGaps() << std::endl;
    os << indent << "AcceptTilted: " << this->GetAcceptTilted() << std::endl;
    os << indent << "AcceptUneven: " << this->GetAcceptUneven() << std::endl;
  }

  void
  GenerateOutputInformation() override
  {
    OptionsType options = m_Options;
    options.progress = [this](double fraction) {
      this->UpdateProgress(static_cast<float>(fraction));
      WorkProgress::CheckAbort(*this);
    };
    m_File = rhombic::OpenScan(m_FileName, options);
    m_Scan = m_File.scan;
    rhombic::AttachPlacement(m_Scan);
  }

  /** Reads the voxels, and completes GetScan(). Reports progress, and throws ProcessAborted. */
  rhombic::Scan
  ReadVoxels()
  {
    this->UpdateProgress(0.0f);
    WorkProgress::CheckAbort(*this);
    rhombic::Scan scan = rhombic::ReadVoxels(m_File);
    rhombic::AttachPlacement(scan);
    m_Scan = rhombic::WithoutVoxels(scan);
    return scan;
  }

private:
  template <typename TValue>
  void
  Assign(TValue & option, const TValue & value)
  {
    if (option != value)
    {
      option = value;
      this->Modified();
    }
  }

  std::string m_FileName;
  OptionsType m_Options;
  rhombic::UnreadScan m_File;
  rhombic::Scan m_Scan;
};

} // namespace itk

#endif
