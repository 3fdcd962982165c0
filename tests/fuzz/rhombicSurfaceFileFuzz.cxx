#include "rhombicFailure.h"
#include "rhombicFuzzFile.h"
#include "rhombicSurfaceFormats.h"

#include <algorithm>
#include <cmath>

using rhombicfuzz::Require;

namespace
{

/** What users of a surface take for granted. */
void
CheckSurface(const rhombic::SceneSurface & scene)
{
  Require(scene.surface.IsNotNull(), "there is a surface");
  const itk::TriangleSurface & surface = *scene.surface;
  Require(surface.GetNormals().empty() || surface.HasNormals(), "all points have normals, or none");
  for (const auto & triangle : surface.GetTriangles())
  {
    Require(std::max({ triangle[0], triangle[1], triangle[2] }) < surface.GetNumberOfPoints(), "corners are points");
  }
  Require(scene.opacity >= 0 && scene.opacity <= 1, "opacity is from 0 to 1");
  for (const double part : scene.colour)
  {
    Require(part >= 0 && part <= 1, "colours are from 0 to 1");
  }
}

} // namespace

/** The first byte says which kind of file the others are. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  constexpr decltype(&rhombic::ReadSTL) readers[]{
    rhombic::ReadSTL,
    rhombic::ReadPLY,
    rhombic::ReadOBJ,
    rhombic::ReadGLB,
    rhombic::Read3MF // VTK reads VTP, in a child process
  };
  if (size == 0)
  {
    return 0;
  }
  try
  {
    const rhombicfuzz::FuzzFile bytes(data + 1, size - 1);
    const rhombic::InputFile file(bytes.Path());
    const auto surfaces = readers[*data % std::size(readers)](file);
    std::for_each(surfaces.begin(), surfaces.end(), CheckSurface);
  }
  catch (const rhombic::Failure & failure)
  {
    Require(failure.GetKind() == rhombic::FailureKind::Unreadable || failure.GetKind() == rhombic::FailureKind::Memory,
            "what is wrong is the file's mistake");
  }
  return 0;
}
