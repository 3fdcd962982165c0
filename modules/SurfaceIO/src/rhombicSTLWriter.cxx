#include "rhombicSTLWriter.h"

#include "rhombicQuietVTK.h"
#include "rhombicSurfaceToPolyData.h"

#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSTLWriter.h>

namespace rhombic
{

std::uintmax_t
WriteSTL(const itk::TriangleSurface & surface, const std::filesystem::path & path)
{
  vtkNew<vtkSTLWriter> writer;
  Silence(*writer);
  writer->SetInputData(SurfaceToPolyData(&surface));
  writer->SetFileTypeToBinary();
  writer->SetHeader("Rhombic SPACE=LPS"); // must not begin with "solid", which announces a text file
  writer->SetFileName(path.c_str());
  writer->Write();

  constexpr std::uintmax_t headerSize = 84;
  constexpr std::uintmax_t triangleSize = 50;
  return headerSize + triangleSize * surface.GetNumberOfTriangles();
}

} // namespace rhombic
