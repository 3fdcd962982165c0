#ifndef rhombicMaskSurface_h
#define rhombicMaskSurface_h

#include "rhombicLabelPieces.h"

#include "itkFCCIsosurfaceMode.h"
#include "itkTriangleSurface.h"

#include <functional>

namespace rhombic
{

/** One connected piece of a label, to be given a surface. */
struct MaskPiece
{
  MaskImage::Pointer mask;                         ///< with MaskMargin voxels around the piece
  std::vector<itk::Point<double, 3>> sliceOrigins; ///< as in Scan, one for each slice of the mask, or none
  itk::ImageRegion<3> scanRegion;                  ///< where the scan is; beyond, the mask is made up
  double volume = 0.0;                             ///< of the piece's voxels in cubic mm
};

/** Voxels that a mask must have around its piece. */
constexpr itk::SizeValueType MaskMargin = 4;

/** The surface of a piece. */
struct MaskSurface
{
  itk::TriangleSurface::Pointer surface;
  double volume = 0.0;    ///< that it encloses, in cubic mm
  double level = 0.0;     ///< of the field at which it was extracted, in voxels
  std::size_t shells = 0; ///< components that enclose something
  bool isFiner = false;   ///< whether its lattice has more sites than asked for
  std::size_t protectedVoxels = 0;
};

/** How surfaces of masks are made. */
struct MaskSurfaceSettings
{
  double density = 0.0; ///< lattice sites per voxel
  itk::FCCIsosurfaceMode mode = itk::FCCIsosurfaceMode::Lean;
  std::uintmax_t maximumMemory = 0;
  std::string name; ///< of what has this surface, for messages
};

/** The surface of a piece, with its volume; see LabelsToSurfaces(). Throws Failure(Memory). */
MaskSurface
MaskToSurface(const MaskPiece & piece, const MaskSurfaceSettings & settings);

} // namespace rhombic

#endif
