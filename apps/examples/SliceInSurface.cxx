// A surface of Rhombic, a slice of the scan as vtkImageSlice, and the axes of the patient as vtkAxesActor in one
// picture.

#include "exampleInput.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkScanFileReader.h"
#include "rhombicSurfaceToPolyData.h"
#include "vtkRhombicHeadlessRenderWindow.h"
#include "vtkRhombicOpaquePass.h"
#include "vtkRhombicSurfacePass.h"

#include <vtkAxesActor.h>
#include <vtkCamera.h>
#include <vtkImageData.h>
#include <vtkImageProperty.h>
#include <vtkImageSlice.h>
#include <vtkImageSliceMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShortArray.h>
#include <vtkWindowToImageFilter.h>

#include <iostream>

using ImageType = itk::Image<short, 3>;

vtkSmartPointer<vtkActor>
MakeSurface(ImageType * image, double threshold)
{
  const auto lattice = itk::CartesianToFCCImageFilter<ImageType>::New();
  lattice->SetInput(image);
  const auto surface = itk::FCCIsosurfaceFilter<itk::FCCImage<short>>::New();
  surface->SetInput(lattice->GetOutput());
  surface->SetIsovalue(threshold);
  surface->Update();
  const vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(rhombic::SurfaceToPolyData(surface->GetOutput()));
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.95, 0.82, 0.57);
  actor->GetProperty()->SetOpacity(0.4);
  return actor;
}

/** The middle slice, where it lies in the patient. The voxels stay the image's. */
vtkSmartPointer<vtkImageSlice>
MakeSlice(ImageType * image)
{
  const vtkNew<vtkShortArray> voxels;
  const auto size = image->GetBufferedRegion().GetSize();
  voxels->SetArray(
    image->GetBufferPointer(), static_cast<vtkIdType>(image->GetBufferedRegion().GetNumberOfPixels()), 1);
  const vtkNew<vtkImageData> data;
  data->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]));
  data->GetPointData()->SetScalars(voxels);
  const vtkNew<vtkMatrix4x4> patientFromIndex;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      patientFromIndex->SetElement(
        static_cast<int>(row), static_cast<int>(axis), image->GetDirection()(row, axis) * image->GetSpacing()[axis]);
    }
    patientFromIndex->SetElement(static_cast<int>(row), 3, image->GetOrigin()[row]);
  }
  const vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSliceNumber(static_cast<int>(size[2] / 2));
  auto slice = vtkSmartPointer<vtkImageSlice>::New();
  slice->SetMapper(mapper);
  slice->SetUserMatrix(patientFromIndex);
  slice->GetProperty()->SetColorWindow(400.0);
  slice->GetProperty()->SetColorLevel(40.0);
  return slice;
}

int
main(int argc, char ** argv)
try
{
  if (argc != 4)
  {
    throw std::runtime_error("usage: SliceInSurface SCAN THRESHOLD OUTPUT.png");
  }
  const auto threshold = example::ParseNumber<double>("THRESHOLD", argv[2]);
  example::RequireOther(argv[3], { argv[1] });
  const auto reader = itk::ScanFileReader<ImageType>::New();
  reader->SetFileName(argv[1]);
  reader->AcceptTiltedOff(); // slices of vtkImageData are neither tilted nor unevenly spaced
  reader->Update();

  const vtkNew<vtkAxesActor> axes; // L, P and S
  axes->SetTotalLength(100.0, 100.0, 100.0);
  axes->SetXAxisLabelText("L");
  axes->SetYAxisLabelText("P");
  axes->SetZAxisLabelText("S");
  const vtkNew<vtkRenderer> renderer;
  renderer->AddActor(MakeSurface(reader->GetOutput(), threshold));
  renderer->AddViewProp(MakeSlice(reader->GetOutput()));
  renderer->AddActor(axes);
  const vtkNew<vtkRhombicSurfacePass> pass;
  pass->GetSurfaces()->SetLights(vtkRhombicOpaquePass::ClinicLights);
  renderer->SetPass(pass);
  renderer->GetActiveCamera()->SetPosition(-0.5, -1.0, 0.6); // from the right, the front and above
  renderer->GetActiveCamera()->SetFocalPoint(0.0, 0.0, 0.0);
  renderer->GetActiveCamera()->SetViewUp(0.0, 0.0, 1.0);
  renderer->ResetCamera();

  const vtkNew<vtkRhombicHeadlessRenderWindow> window;
  if (!window->SupportsOpenGL())
  {
    throw std::runtime_error(window->GetOpenGLSupportMessage());
  }
  window->SetSize(800, 800);
  window->AddRenderer(renderer);
  const vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  const vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(argv[3]);
  writer->Write();
  if (writer->GetErrorCode() != 0)
  {
    throw std::runtime_error(std::string("Cannot write ") + argv[3] + "; check that its folder exists");
  }
}
catch (const std::exception & error)
{
  return example::Report(error);
}
