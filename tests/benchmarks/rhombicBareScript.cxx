// The script that rhombic mesh is compared with: ITK reads the first DICOM series of a folder, VTK extracts the
// isosurface and writes it as binary STL. It checks nothing.

#include "itkGDCMImageIO.h"
#include "itkGDCMSeriesFileNames.h"
#include "itkImageSeriesReader.h"

#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>
#include <vtkSTLWriter.h>

#include <cstdlib>
#include <iostream>

int
main(int argc, char ** argv)
{
  if (argc != 4)
  {
    std::cerr << "Usage: rhombic-bare-script FOLDER ISOVALUE SURFACE.stl\n";
    return 2;
  }
  try
  {
    using ImageType = itk::Image<std::int16_t, 3>;
    const auto names = itk::GDCMSeriesFileNames::New();
    names->SetDirectory(argv[1]);
    const auto reader = itk::ImageSeriesReader<ImageType>::New();
    reader->SetImageIO(itk::GDCMImageIO::New());
    reader->SetFileNames(names->GetInputFileNames());
    reader->Update();
    ImageType * const image = reader->GetOutput();

    vtkNew<vtkShortArray> values;
    values->SetArray(image->GetBufferPointer(), static_cast<vtkIdType>(image->GetPixelContainer()->Size()), 1);
    const auto size = image->GetBufferedRegion().GetSize();
    vtkNew<vtkImageData> volume;
    volume->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]));
    volume->SetSpacing(image->GetSpacing().GetDataPointer());
    volume->SetOrigin(image->GetOrigin().GetDataPointer());
    volume->GetPointData()->SetScalars(values);

    vtkNew<vtkFlyingEdges3D> extraction;
    extraction->SetInputData(volume);
    extraction->SetValue(0, std::atof(argv[2]));
    extraction->ComputeNormalsOff();
    vtkNew<vtkSTLWriter> writer;
    writer->SetInputConnection(extraction->GetOutputPort());
    writer->SetFileTypeToBinary();
    writer->SetFileName(argv[3]);
    return writer->Write() == 1 ? 0 : 1;
  }
  catch (const std::exception & error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
