#include "itkInputSamples.h"

#include "itkImage.h"
#include "itkImageSource.h"

#include <gtest/gtest.h>

namespace
{

using Image = itk::Image<float, 3>;
using Region = itk::ImageRegion<3>;

class Source : public itk::ImageSource<Image>
{
public:
  using Self = Source;
  using Superclass = itk::ImageSource<Image>;
  using Pointer = itk::SmartPointer<Self>;
  itkNewMacro(Self);
  itkTypeMacro(Source, ImageSource);
};

std::string
Refusal(const Image & image, const Region & needed)
{
  const auto filter = Source::New();
  try
  {
    itk::VerifyInputSamples(*filter, image, needed);
  }
  catch (const itk::ExceptionObject & failure)
  {
    return failure.GetDescription();
  }
  return {};
}

const Region Whole{ { { -2, 3, 5 } }, { { 4, 5, 6 } } };

TEST(InputSamples, AreThereOrTheRemedyIsTold)
{
  const auto image = Image::New();
  image->SetRegions(Whole);
  EXPECT_NE(Refusal(*image, Whole).find("never allocated: call its Allocate()"), std::string::npos);
  image->SetBufferedRegion({ { { -2, 3, 6 } }, { { 4, 5, 4 } } });
  image->Allocate();
  EXPECT_EQ(Refusal(*image, image->GetBufferedRegion()), "");
  EXPECT_EQ(Refusal(*image, { { { -1, 4, 9 } }, { { 3, 4, 1 } } }), "");
  EXPECT_EQ(Refusal(*image, { { { 0, 0, 0 } }, { { 0, 5, 6 } } }), "") << "no samples are there always";
  EXPECT_EQ(Refusal(*image, Whole),
            "Source: of the input, samples [4, 5, 6] from index [-2, 3, 5] are needed, but its buffer holds [4, 5, 4] "
            "from [-2, 3, 6] and it has no source: turn its ReleaseDataFlag off, or fill it anew before each update.");
  EXPECT_NE(Refusal(*image, { { { -1, 4, 9 } }, { { 4, 4, 1 } } }), "") << "a sample too far along x";
  image->ReleaseData();
  EXPECT_NE(Refusal(*image, Whole).find("holds [0, 0, 0]"), std::string::npos);
}

TEST(InputSamples, NameASourceThatDoesNotMakeThem)
{
  const auto source = Source::New();
  source->GetOutput()->SetRegions(Whole);
  source->GetOutput()->SetBufferedRegion(Region());
  EXPECT_NE(Refusal(*source->GetOutput(), Whole).find("call its ResetPipeline()"), std::string::npos);
}

} // namespace
