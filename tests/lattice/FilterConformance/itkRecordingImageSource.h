#ifndef itkRecordingImageSource_h
#define itkRecordingImageSource_h

#include "itkImageAlgorithm.h"
#include "itkImageSource.h"

#include <vector>

namespace filtertest
{

/** Hands out copies of exactly those parts of an image that are asked for, and remembers them. */
template <typename TImage>
class RecordingImageSource : public itk::ImageSource<TImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(RecordingImageSource);

  using Self = RecordingImageSource;
  using Superclass = itk::ImageSource<TImage>;
  using Pointer = itk::SmartPointer<Self>;
  using RegionType = typename TImage::RegionType;

  itkFactorylessNewMacro(Self);
  itkTypeMacro(RecordingImageSource, ImageSource);

  static Pointer
  New(const TImage * image)
  {
    const Pointer source = Self::New();
    source->m_Image = image;
    return source;
  }

  const std::vector<RegionType> &
  GetRequests() const
  {
    return m_Requests;
  }

protected:
  RecordingImageSource() = default;
  ~RecordingImageSource() override = default;

  void
  GenerateOutputInformation() override
  {
    this->GetOutput()->CopyInformation(m_Image);
  }

  void
  GenerateData() override
  {
    const RegionType region = this->GetOutput()->GetRequestedRegion();
    m_Requests.push_back(region);
    this->AllocateOutputs();
    itk::ImageAlgorithm::Copy(m_Image.GetPointer(), this->GetOutput(), region, region);
  }

private:
  typename TImage::ConstPointer m_Image;
  std::vector<RegionType> m_Requests;
};

} // namespace filtertest

#endif
