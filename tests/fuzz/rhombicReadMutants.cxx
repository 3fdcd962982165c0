// Reads the files and folders named on standard input, one a line, in this process, and prints a line for each: what
// was read of it, with all digits, or "refused" and the sentence. malformed.py compares it with a reading of its own.
#include "rhombicBatchCases.h"
#include "rhombicFailure.h"
#include "rhombicPresets.h"
#include "rhombicScanReader.h"
#include "rhombicSurfaceIO.h"

#include <cstdio>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

namespace fs = std::filesystem;

namespace
{

/** One line, whatever names hold. */
std::string
Quoted(const std::string & text)
{
  std::ostringstream hex;
  hex << std::hex;
  for (const unsigned char letter : text)
  {
    hex << (letter < 16 ? "0" : "") << unsigned(letter);
  }
  return "x" + hex.str();
}

void
PrintScan(const fs::path & path)
{
  rhombic::ScanReadOptions options;
  options.maximumMemory = std::uintmax_t{ 1 } << 28;
  const rhombic::Scan scan = rhombic::ReadVoxels(rhombic::OpenScan(path, options));
  const itk::ImageBase<3> & geometry = rhombic::GeometryOf(scan.image);
  std::cout << "scan";
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    std::cout << ' ' << geometry.GetLargestPossibleRegion().GetSize(axis);
  }
  for (unsigned int axis = 0; axis < 4; ++axis) // the first voxel, and one step along each axis
  {
    itk::Index<3> index{};
    if (axis > 0)
    {
      index[axis - 1] = 1;
    }
    const auto point = geometry.TransformIndexToPhysicalPoint<double>(index);
    std::cout << ' ' << point[0] << ' ' << point[1] << ' ' << point[2];
  }
  std::cout << " values";
  std::visit(
    [](const auto & image) {
      const auto * const begin = image->GetBufferPointer();
      const std::size_t count = image->GetBufferedRegion().GetNumberOfPixels();
      for (std::size_t n = 0; n < std::min<std::size_t>(count, 4096); ++n)
      {
        std::cout << ' ' << static_cast<double>(begin[n]);
      }
    },
    scan.image);
  std::cout << " layers " << scan.furtherLayers.size();
  for (const auto & label : scan.labels)
  {
    std::cout << " label " << label.value;
  }
}

void
PrintSurfaces(const fs::path & path)
{
  std::cout << "surfaces";
  for (const rhombic::SceneSurface & scene : rhombic::ReadSurfaces(path))
  {
    for (const auto & triangle : scene.surface->GetTriangles())
    {
      for (const auto corner : triangle)
      {
        const auto & point = scene.surface->GetPoints().at(corner);
        std::cout << ' ' << point[0] << ' ' << point[1] << ' ' << point[2];
      }
    }
  }
}

void
PrintPreset(const fs::path & path)
{
  std::ifstream file(path, std::ios::binary);
  std::cout << "preset";
  const auto preset = rhombic::ParsePreset({ std::istreambuf_iterator<char>(file), {} }, path.string());
  for (const rhombic::SurfaceRequest & surface : preset.surfaces)
  {
    std::cout << ' ' << Quoted(surface.name) << ' ' << surface.isovalue.value_or(-12345.0) << ' ' << surface.opacity;
  }
}

void
PrintCases(const fs::path & path)
{
  std::cout << "cases";
  for (const rhombic::BatchCase & batchCase : rhombic::FindCases(path).cases)
  {
    std::cout << ' ' << Quoted(batchCase.name) << ' ' << Quoted(batchCase.scan.string()) << ' '
              << Quoted(batchCase.labels.string());
  }
}

void
PrintLabels(const fs::path & path)
{
  std::cout << "labels";
  for (const rhombic::Label & label : rhombic::ReadLabelTable(path))
  {
    std::cout << ' ' << label.value << ' ' << Quoted(label.name);
  }
}

void
Print(const fs::path & path)
{
  const std::string extension = path.extension().string();
  if (rhombic::IsSurfacePath(path))
  {
    PrintSurfaces(path);
  }
  else if (extension == ".yaml")
  {
    PrintPreset(path);
  }
  else if (extension == ".tsv")
  {
    path.filename().string().rfind("labels", 0) == 0 ? PrintLabels(path) : PrintCases(path);
  }
  else
  {
    PrintScan(path);
  }
}

} // namespace

int
main()
{
  std::cout.precision(17);
  for (std::string path; std::getline(std::cin, path);)
  {
    try
    {
      Print(path);
    }
    catch (const rhombic::Failure & failure)
    {
      const bool isOwnFault = failure.GetKind() == rhombic::FailureKind::Internal;
      std::cout << '\n' << (isOwnFault ? "internal " : "refused ") << Quoted(failure.GetDescription());
    }
    catch (const std::exception & error)
    {
      std::cout << '\n' << "exception " << Quoted(error.what());
    }
    std::cout << "\nend" << std::endl;
  }
}
