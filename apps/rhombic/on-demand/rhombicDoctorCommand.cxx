#include "detail/rhombicPictureCodec.h"
#include "rhombicCommandLine.h"
#include "rhombicFailure.h"
#include "rhombicMemoryBudget.h"
#include "rhombicSurfaceRenderer.h"

#include "itkMultiThreaderBase.h"
#include "itkTriangleSurface.h"

#include <iostream>

namespace rhombic
{
namespace
{

/** Renders one triangle; returns a description of the OpenGL that did. */
std::string
TryToRender()
{
  auto triangle = itk::TriangleSurface::New();
  triangle->GetPoints() = { { 0.0f, 0.0f, 0.0f }, { 10.0f, 0.0f, 0.0f }, { 0.0f, 0.0f, 10.0f } };
  triangle->GetTriangles() = { { 0, 1, 2 } };
  RenderSettings settings;
  settings.width = 64;
  settings.height = 64;
  SurfaceRenderer renderer;
  renderer.Render({ { { "triangle", triangle.GetPointer() } }, {}, {} }, settings, { View() });
  return renderer.GetBackendDescription();
}

void
Doctor()
{
  std::cout << VersionText();
  std::cout << "threads      " << itk::MultiThreaderBase::GetGlobalDefaultNumberOfThreads() << '\n';
  std::cout << "memory       " << DescribeBytes(FreeMemory()) << " free\n";
  std::cout
    << "built for    DICOM folders and multi-frame files (uncompressed, JPEG, JPEG-LS, JPEG 2000, RLE), DICOM SEG,\n"
       "             NIfTI-1 and -2 (.nii, or .hdr with .img, either with .gz), Analyze 7.5 (--analyze),\n"
       "             NRRD (.nrrd, .nhdr, .seg.nrrd), MetaImage (.mha, .mhd), OME-Zarr 0.4 folders,\n"
       "             lattice volumes (.fcc.nrrd)\n";
  for (const BackendProbe & probe : SurfaceRenderer::ProbeBackends())
  {
    std::cout << "display      " << probe.name << ": " << (probe.usable ? "works, " : "no, ") << probe.detail << '\n';
  }
  std::cout << "rendering    works: " << TryToRender() << '\n';
  GetPictureCodec(); // throws if pictures can't be written
}

} // namespace

CommandRun
AddDoctorCommand(CommandSettings &)
{
  return WithoutOutputs([](const CommandContext &) { Doctor(); });
}

} // namespace rhombic
