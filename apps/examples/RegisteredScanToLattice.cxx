// Brings a scan that was registered to another one straight onto the other's lattice: one interpolation instead of two.

#include "exampleInput.h"
#include "itkBSplineInterpolateImageFunction.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkResampleImageFilter.h"
#include "itkTransformFileReader.h"
#include "itkTxtTransformIOFactory.h"
#include "rhombicFCCImageFile.h"

int
main(int argc, char ** argv)
try
{
  if (argc != 5)
  {
    throw std::runtime_error("usage: RegisteredScanToLattice FIXED MOVING TRANSFORM.tfm OUTPUT.fcc.nrrd");
  }
  example::RequireOther(argv[4], { argv[1], argv[2], argv[3] });
  using LatticeType = itk::FCCImage<float>;
  itk::TxtTransformIOFactory::RegisterOneFactory();
  const auto reader = itk::TransformFileReader::New();
  reader->SetFileName(argv[3]);
  example::ReadAs("an ITK transform in text", argv[3], [&] { reader->Update(); });
  const auto & transforms = *reader->GetModifiableTransformList();
  using TransformType = itk::Transform<double, 3, 3>;
  const auto * const transform =
    transforms.size() == 1 ? dynamic_cast<TransformType *>(transforms.front().GetPointer()) : nullptr;
  if (transform == nullptr)
  {
    throw std::runtime_error("Only one transform of 3-D points can be applied; save several as a CompositeTransform");
  }
  const auto layOut = [](const auto & image) { // the lattice of the fixed scan, without its samples
    const auto filter = itk::CartesianToFCCImageFilter<typename std::decay_t<decltype(image)>::ObjectType>::New();
    filter->SetInput(image);
    filter->UpdateOutputInformation();
    return itk::SmartPointer<itk::ImageBase<3>>(filter->GetOutput());
  };
  const auto lattice = std::visit(layOut, example::ReadEvenScan(argv[1]).image);
  const auto resample = [&](const auto & image) {
    using ImageType = typename std::decay_t<decltype(image)>::ObjectType;
    const auto filter = itk::ResampleImageFilter<ImageType, LatticeType>::New();
    filter->SetInput(image);
    filter->SetTransform(transform); // from points of the fixed scan to points of the moving one
    filter->SetInterpolator(itk::BSplineInterpolateImageFunction<ImageType>::New());
    filter->SetOutputParametersFromImage(lattice);
    filter->SetDefaultPixelValue(example::LowestOf(*image)); // air, for CT
    filter->Update();
    return LatticeType::Pointer(filter->GetOutput());
  };
  rhombic::WriteFCCImage(std::visit(resample, example::ReadEvenScan(argv[2]).image), argv[4]);
}
catch (const std::exception & error)
{
  return example::Report(error);
}
