#include "rhombicVTPWriter.h"

#include "rhombicQuietVTK.h"
#include "rhombicSurfaceToPolyData.h"

#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace rhombic
{
namespace
{

/** Says where the coordinates live in the way 3D Slicer looks for it. */
void
AddSpace(vtkPolyData & polyData)
{
  vtkNew<vtkStringArray> space;
  space->SetName("SPACE");
  space->InsertNextValue("LPS");
  polyData.GetFieldData()->AddArray(space);
}

std::string
ReadPart(std::ifstream & file, std::uintmax_t from, std::uintmax_t size)
{
  std::string text(size, '\0');
  file.seekg(static_cast<std::streamoff>(from));
  file.read(text.data(), static_cast<std::streamsize>(size));
  return file ? text : std::string();
}

bool
IsComplete(const itk::TriangleSurface & surface, const std::filesystem::path & path, std::uintmax_t size)
{
  constexpr std::uintmax_t headSize = 4096;
  constexpr std::uintmax_t tailSize = 64;
  if (size < tailSize)
  {
    return false;
  }
  std::ifstream file(path, std::ios::binary);
  const std::string head = ReadPart(file, 0, std::min(headSize, size));
  const std::string tail = ReadPart(file, size - tailSize, tailSize);
  const auto has = [](const std::string & text, const std::string & part) {
    return text.find(part) != std::string::npos;
  };
  return has(head, "NumberOfPoints=\"" + std::to_string(surface.GetNumberOfPoints()) + "\"") &&
         has(head, "NumberOfPolys=\"" + std::to_string(surface.GetNumberOfTriangles()) + "\"") &&
         has(tail, "</AppendedData>\n</VTKFile>\n");
}

} // namespace

std::uintmax_t
WriteVTP(const itk::TriangleSurface & surface, const std::filesystem::path & path)
{
  const auto polyData = SurfaceToPolyData(&surface);
  AddSpace(*polyData);
  vtkNew<vtkXMLPolyDataWriter> writer;
  Silence(*writer);
  writer->SetInputData(polyData);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetHeaderTypeToUInt64();
  writer->SetFileName(path.c_str());
  const bool claimed = writer->Write() != 0;

  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  // The size it must have is not known beforehand; one more than it has says that it is incomplete.
  return claimed && !error && IsComplete(surface, path, size) ? size : (error ? 1 : size + 1);
}

} // namespace rhombic
