#include "itkNativeScanFileReader.h"
#include "rhombicLatticeToSurfaces.h"
#include "rhombicScanToLattice.h"
#include "rhombicPictureIO.h"
#include "rhombicSurfaceIO.h"
#include "rhombicSurfaceRenderer.h"
#include "rhombicSurfaceToPolyData.h"

#include <vtkPolyData.h>

#include <iostream>

/** Reads the scan named first, and writes bone as a mesh and as a picture into the folder named second. */
int
main(int, char ** argv)
{
  const auto reader = itk::NativeScanFileReader::New();
  reader->SetFileName(argv[1]);
  reader->Update();
  const rhombic::FCCVolume lattice = rhombic::ScanToLattice(*reader->GetOutput()->Get(), {}, {});
  rhombic::SurfaceRequest bone;
  bone.name = "bone";
  bone.isovalue = 375.5;
  const auto extracted = rhombic::LatticeToSurfaces(lattice, { bone }, itk::FCCIsosurfaceMode::Lean, {});
  const std::vector<rhombic::SceneSurface> surfaces(extracted.begin(), extracted.end());
  const std::filesystem::path folder = argv[2];
  rhombic::WriteSurfaces(surfaces, folder / "bone.stl");
  rhombic::SurfaceRenderer renderer;
  rhombic::WritePicture(
    renderer.Render({ surfaces, {}, {} }, {}, { rhombic::View() }).front().picture, folder / "bone.png", {});
  std::cout << rhombic::SurfaceToPolyData(surfaces.front().surface)->GetNumberOfPolys() << " triangles\n";
}
