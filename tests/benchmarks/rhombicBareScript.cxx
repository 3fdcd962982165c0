// The script that rhombic mesh is compared with: ITK reads the first DICOM series of a folder, or a volume file of
// uint16, VTK extracts the isosurface and writes it as binary STL. It checks nothing.

#include "itkGDCMImageIO.h"
#include "itkGDCMSeriesFileNames.h"
#include "itkImageFileReader.h"
#include "itkImageSeriesReader.h"
#include "itkMetaImageIO.h"

#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSTLWriter.h>
#include <vtkShortArray.h>
#include <vtkUnsignedShortArray.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace
{

template <typename TArray, typename TImage>
int
WriteSurface(TImage & image, double isovalue, const char * file)
{
  vtkNew<TArray> values;
  values->SetArray(image.GetBufferPointer(), static_cast<vtkIdType>(image.GetPixelContainer()->Size()), 1);
  const auto size = image.GetBufferedRegion().GetSize();
  vtkNew<vtkImageData> volume;
  volume->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]));
  volume->SetSpacing(image.GetSpacing().GetDataPointer());
  volume->SetOrigin(image.GetOrigin().GetDataPointer());
  volume->GetPointData()->SetScalars(values);

  vtkNew<vtkFlyingEdges3D> extraction;
  extraction->SetInputData(volume);
  extraction->SetValue(0, isovalue);
  extraction->ComputeNormalsOff();
  vtkNew<vtkSTLWriter> writer;
  writer->SetInputConnection(extraction->GetOutputPort());
  writer->SetFileTypeToBinary();
  writer->SetFileName(file);
  return writer->Write() == 1 ? 0 : 1;
}

} // namespace

int
main(int argc, char ** argv)
{
  if (argc != 4)
  {
    std::cerr << "Usage: rhombic-bare-script FOLDER-OR-FILE.mhd ISOVALUE SURFACE.stl\n";
    return 2;
  }
  try
  {
    if (!std::filesystem::is_directory(argv[1]))
    {
      const auto reader = itk::ImageFileReader<itk::Image<std::uint16_t, 3>>::New();
      reader->SetImageIO(itk::MetaImageIO::New());
      reader->SetFileName(argv[1]);
      reader->Update();
      return WriteSurface<vtkUnsignedShortArray>(*reader->GetOutput(), std::atof(argv[2]), argv[3]);
    }
    const auto names = itk::GDCMSeriesFileNames::New();
    names->SetDirectory(argv[1]);
    const auto reader = itk::ImageSeriesReader<itk::Image<std::int16_t, 3>>::New();
    reader->SetImageIO(itk::GDCMImageIO::New());
    reader->SetFileNames(names->GetInputFileNames());
    reader->Update();
    return WriteSurface<vtkShortArray>(*reader->GetOutput(), std::atof(argv[2]), argv[3]);
  }
  catch (const std::exception & error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
