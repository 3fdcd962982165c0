#ifndef itkLabelMapFileReader_h
#define itkLabelMapFileReader_h

#include "itkScanFileReader.h"
#include "rhombicLabelMap.h"

namespace itk
{

/** \class LabelMapFileReader
 * \brief Reads a label map, and the names, colours and volumes of its labels.
 *
 * It reads what ScanFileReader reads, DICOM segmentations (SEG) and folders of masks among them. Throws
 * rhombic::Failure (Usage) for labels that overlap, which one image cannot hold: rhombic::ReadLabelMap() has them.
 * Throws rhombic::Failure when the values look like intensities and there is no label table.
 *
 * \ingroup ScanIO
 */
template <typename TOutputImage>
class ITK_TEMPLATE_EXPORT LabelMapFileReader : public ScanFileReader<TOutputImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LabelMapFileReader);

  using Self = LabelMapFileReader;
  using Superclass = ScanFileReader<TOutputImage>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(LabelMapFileReader, ScanFileReader);

  /** The file of the label table (see rhombic::ReadLabelTable()). Default empty: the table in the file, or else the one
   * beside it (see rhombic::FindLabelTable()). */
  itkSetStringMacro(LabelTableFileName);
  itkGetStringMacro(LabelTableFileName);

  /** The labels that the volume holds, by value, without the background 0. Empty before Update(). */
  const std::vector<rhombic::LabelSummary> &
  GetLabels() const
  {
    return m_Labels;
  }

protected:
  LabelMapFileReader() = default;
  ~LabelMapFileReader() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "LabelTableFileName: " << m_LabelTableFileName << std::endl;
    os << indent << "Labels: " << m_Labels.size() << std::endl;
  }

  void
  Inspect(const rhombic::Scan & scan) override
  {
    m_Labels = rhombic::FindLabels(scan, { { this->GetFileName() }, m_LabelTableFileName });
  }

private:
  std::string m_LabelTableFileName;
  std::vector<rhombic::LabelSummary> m_Labels;
};

} // namespace itk

#endif
