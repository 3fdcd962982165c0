// The script that rhombic mesh and render are compared with on label maps: ITK reads the map, and VTK makes a surface
// of each label, smooths it as 3D Slicer does by default, and writes it as binary STL. It checks nothing.

#include "itkImageFileReader.h"
#include "itkMetaImageIOFactory.h"
#include "itkNiftiImageIOFactory.h"
#include "itkNrrdImageIOFactory.h"

#include <vtkDiscreteFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSTLWriter.h>
#include <vtkUnsignedShortArray.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>
#include <iostream>
#include <set>
#include <string>

int
main(int argc, char ** argv)
{
  if (argc != 3)
  {
    std::cerr << "Usage: rhombic-bare-label-script MAP FOLDER\n";
    return 2;
  }
  try
  {
    itk::MetaImageIOFactory::RegisterOneFactory();
    itk::NiftiImageIOFactory::RegisterOneFactory();
    itk::NrrdImageIOFactory::RegisterOneFactory();
    using ImageType = itk::Image<std::uint16_t, 3>;
    const auto reader = itk::ImageFileReader<ImageType>::New();
    reader->SetFileName(argv[1]);
    reader->Update();
    ImageType * const image = reader->GetOutput();
    const auto voxels = image->GetPixelContainer()->Size();

    vtkNew<vtkUnsignedShortArray> values;
    values->SetArray(image->GetBufferPointer(), static_cast<vtkIdType>(voxels), 1);
    const auto size = image->GetBufferedRegion().GetSize();
    vtkNew<vtkImageData> volume;
    volume->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]));
    volume->SetSpacing(image->GetSpacing().GetDataPointer());
    volume->SetOrigin(image->GetOrigin().GetDataPointer());
    volume->GetPointData()->SetScalars(values);

    std::set<std::uint16_t> labels;
    for (const std::uint16_t * voxel = image->GetBufferPointer(); voxel < image->GetBufferPointer() + voxels; ++voxel)
    {
      if (voxel == image->GetBufferPointer() || voxel[0] != voxel[-1])
      {
        labels.insert(*voxel);
      }
    }
    labels.erase(0);
    for (const std::uint16_t label : labels)
    {
      vtkNew<vtkDiscreteFlyingEdges3D> extraction;
      extraction->SetInputData(volume);
      extraction->SetValue(0, label);
      extraction->ComputeNormalsOff();
      extraction->ComputeGradientsOff();
      vtkNew<vtkWindowedSincPolyDataFilter> smoothing;
      smoothing->SetInputConnection(extraction->GetOutputPort());
      smoothing->SetPassBand(0.01);
      smoothing->SetNumberOfIterations(20);
      smoothing->BoundarySmoothingOff();
      smoothing->FeatureEdgeSmoothingOff();
      smoothing->NonManifoldSmoothingOn();
      smoothing->NormalizeCoordinatesOn();
      vtkNew<vtkSTLWriter> writer;
      writer->SetInputConnection(smoothing->GetOutputPort());
      writer->SetFileTypeToBinary();
      writer->SetFileName((std::string(argv[2]) + "/" + std::to_string(label) + ".stl").c_str());
      if (writer->Write() != 1)
      {
        return 1;
      }
    }
    return 0;
  }
  catch (const std::exception & error)
  {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
