// A pipeline of ITK's own classes, which reads with Rhombic's checks: itk::ImageFileReader, a filter, and a writer.

#include "exampleInput.h"
#include "itkBinShrinkImageFilter.h"
#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkMetaImageIOFactory.h"
#include "itkScanImageIOFactory.h"

int
main(int argc, char ** argv)
try
{
  if (argc != 4)
  {
    throw std::runtime_error("usage: ShrinkScan SCAN FACTOR OUTPUT.mha");
  }
  itk::MetaImageIOFactory::RegisterOneFactory(); // ITK's, which writes; programs with ITK_USE_FILE have them all
  itk::ScanImageIOFactory::RegisterOneFactory(); // ours, which reads: the one line
  using ImageType = itk::Image<short, 3>;
  const auto reader = itk::ImageFileReader<ImageType>::New();
  reader->SetFileName(argv[1]); // a DICOM folder, or a DICOM, NIfTI, NRRD or MetaImage file
  const auto shrink = itk::BinShrinkImageFilter<ImageType, ImageType>::New();
  shrink->SetInput(reader->GetOutput());
  shrink->SetShrinkFactors(example::ParseNumber<unsigned int>("FACTOR", argv[2], 1));
  const auto writer = itk::ImageFileWriter<ImageType>::New();
  writer->SetInput(shrink->GetOutput());
  writer->SetFileName(argv[3]);
  writer->Update();
}
catch (const std::exception & error)
{
  return example::Report(error);
}
