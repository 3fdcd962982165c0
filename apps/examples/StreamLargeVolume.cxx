// The surface of a volume that is larger than the memory: reading, resampling and extraction go through it slab by
// slab.
//
//   StreamLargeVolume volume.mha 250.5 64 surface.stl
//
// Two slabs of the volume are in memory at a time: one as it was read, one on the lattice; for each tenth plane of
// them, about 20 planes in float; two bits for each sample; and the surface. The file is read three times; uncompressed
// MetaImage files can be read in slabs, other files come whole. The mesh file is the same for any number of slabs.

#include "exampleInput.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkImageFileReader.h"
#include "itkMetaImageIOFactory.h"
#include "itkNrrdImageIOFactory.h"
#include "rhombicFCCImageFile.h"
#include "rhombicSurfaceIO.h"

int
main(int argc, char ** argv)
try
{
  if (argc != 5)
  {
    throw std::runtime_error("usage: StreamLargeVolume VOLUME ISOVALUE SLABS SURFACE");
  }
  const auto isovalue = example::ParseNumber<double>("ISOVALUE", argv[2]);
  const auto slabs = example::ParseNumber<unsigned int>("SLABS", argv[3], 1);

  if (rhombic::IsFCCImageFile(argv[1]))
  {
    throw std::runtime_error(std::string(argv[1]) + " is on the lattice already; give the scan it was made from");
  }
  itk::MetaImageIOFactory::RegisterOneFactory();
  itk::NrrdImageIOFactory::RegisterOneFactory();
  using PixelType = std::int16_t; // pixel type that the file must have
  using VolumeType = itk::Image<PixelType, 3>;
  const auto reader = itk::ImageFileReader<VolumeType>::New();
  reader->SetFileName(argv[1]);
  example::ReadAs("a MetaImage or NRRD volume", argv[1], [&] { reader->UpdateOutputInformation(); });
  example::RequirePixels<PixelType>(*reader->GetImageIO());
  reader->ReleaseDataFlagOn(); // its slab is released as soon as the lattice slab is made

  const auto lattice = itk::CartesianToFCCImageFilter<VolumeType>::New();
  lattice->SetInput(reader->GetOutput());
  lattice->ReleaseDataFlagOn();

  const auto isosurface = itk::FCCIsosurfaceFilter<itk::FCCImage<PixelType>>::New();
  isosurface->SetInput(lattice->GetOutput());
  isosurface->SetIsovalue(isovalue);
  isosurface->SetNumberOfStreamDivisions(slabs);
  isosurface->Update();

  rhombic::WriteSurfaces({ { "surface", isosurface->GetOutput() } }, argv[4]);
}
catch (const std::exception & error)
{
  return example::Report(error);
}
