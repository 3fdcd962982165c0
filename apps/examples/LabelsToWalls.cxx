// The walls between the labels of a label map, as one mesh in a VTP file: neighbours share their wall. Each triangle
// has its two labels in the cell array BoundaryLabels, as the output of vtkSurfaceNets3D has.

#include "exampleInput.h"
#include "itkFCCLabelSurfaceFilter.h"
#include "itkLabelMapFileReader.h"
#include "itkLabelsToFCCFilter.h"
#include "itkTriangleSurfaceMeasures.h"
#include "rhombicSurfaceToPolyData.h"

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkUnsignedShortArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <iostream>

int
main(int argc, char ** argv)
try
{
  if (argc != 3)
  {
    throw std::runtime_error("usage: LabelsToWalls LABELS OUTPUT.vtp");
  }
  example::RequireOther(argv[2], { argv[1] });
  const auto reader = itk::LabelMapFileReader<itk::Image<std::uint16_t, 3>>::New();
  reader->SetFileName(argv[1]);
  const auto toLattice = itk::LabelsToFCCFilter::New();
  toLattice->SetInput(reader->GetOutput());
  toLattice->Update();
  const auto extract = itk::FCCLabelSurfaceFilter::New();
  extract->SetInput(toLattice->GetOutput());
  extract->SetWeights(toLattice->GetWeights());
  extract->Update();
  itk::LabelWalls * const walls = extract->GetOutput();

  const vtkSmartPointer<vtkPolyData> polyData = rhombic::SurfaceToPolyData(walls);
  vtkNew<vtkUnsignedShortArray> labels;
  labels->SetName("BoundaryLabels");
  labels->SetNumberOfComponents(2);
  labels->SetNumberOfTuples(static_cast<vtkIdType>(walls->GetNumberOfTriangles()));
  for (std::size_t n = 0; n < walls->GetNumberOfTriangles(); ++n)
  {
    const auto & [front, back] = walls->GetTriangleLabels()[n];
    labels->SetTypedComponent(static_cast<vtkIdType>(n), 0, front);
    labels->SetTypedComponent(static_cast<vtkIdType>(n), 1, back);
  }
  polyData->GetCellData()->AddArray(labels);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(polyData);
  writer->SetFileName(argv[2]);
  if (writer->Write() == 0)
  {
    throw std::runtime_error(std::string(argv[2]) + " can't be written");
  }
  std::cout << "triangles: " << walls->GetNumberOfTriangles() << '\n';
  for (const rhombic::LabelSummary & summary : reader->GetLabels())
  {
    const auto surface = walls->ExtractLabel(static_cast<std::uint16_t>(summary.label.value));
    std::cout << summary.label.name << ": " << itk::ComputeTriangleSurfaceVolume(*surface) / 1000.0 << " ml\n";
  }
}
catch (const std::exception & error)
{
  return example::Report(error);
}
