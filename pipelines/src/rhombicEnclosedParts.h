#ifndef rhombicEnclosedParts_h
#define rhombicEnclosedParts_h

#include "rhombicCoarseScan.h"
#include "rhombicLatticePipeline.h"

namespace rhombic
{

/** The values of a lattice in blocks of about 4 mm. */
struct LatticeBlocks
{
  std::array<std::size_t, 3> samplesPerBlock{};
  DistanceImage::Pointer mean;
  MaskImage::Pointer isUniform; ///< blocks whose values are all the same
};

/** Which blocks are on a request's side of its isovalue, but not in the body (see SurfaceRequest::Parts::Enclosed). */
struct Surroundings
{
  LatticeBlocks blocks;
  MaskImage::Pointer around; ///< the body
  MaskImage::Pointer cutOff; ///< what has to be cut off what is in the body, as no tissue lies between; else null
};

Surroundings
FindSurroundings(const FCCVolume & volume, const SurfaceRequest & request);

/** A copy of the volume in which what is to be cut off is on the other side of the isovalue. */
FCCVolume
CutOff(const FCCVolume & volume, const Surroundings & surroundings, const SurfaceRequest & request);

/** Keeps the parts of a surface that are in the body, and tells what it leaves out. */
EnclosedParts
KeepEnclosedParts(itk::TriangleSurface & surface, const FCCVolume & volume, const Surroundings & surroundings);

} // namespace rhombic

#endif
