#ifndef rhombicMaskSurface_h
#define rhombicMaskSurface_h

#include "rhombicLabelPieces.h"

#include "itkFCCIsosurfaceMode.h"
#include "itkTriangleSurface.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace rhombic
{

/** Voxels that a mask must have around its piece. */
constexpr itk::SizeValueType MaskMargin = 4;

/** One connected piece of a label. */
struct MaskPiece
{
  MaskImage::Pointer mask;                         ///< with MaskMargin voxels around the piece
  std::vector<itk::Point<double, 3>> sliceOrigins; ///< as in Scan, one for each slice of the mask, or none
  itk::ImageRegion<3> scanRegion;                  ///< the scan's part of the mask; the rest continues its border
  double volume = 0.0;                             ///< volume of the piece's voxels in mm^3
};

/** The surface of a piece. */
struct MaskSurface
{
  itk::TriangleSurface::Pointer surface;
  double volume = 0.0;    ///< mm^3
  double level = 0.0;     ///< isovalue of the field, in voxels
  std::size_t shells = 0; ///< components of positive volume
  bool isFiner = false;   ///< whether its lattice has more sites than asked for
  std::size_t protectedVoxels = 0;
};

/** How surfaces of masks are made. */
struct MaskSurfaceSettings
{
  double density = 0.0; ///< lattice sites per voxel
  itk::FCCIsosurfaceMode mode = itk::FCCIsosurfaceMode::Lean;
  std::uintmax_t maximumMemory = 0;
  std::string name;         ///< the label's, for messages
  bool onOneThread = false; ///< does all on the calling thread, so that other threads can do other pieces
};

/** The surface of a piece, with its volume; see LabelsToSurfaces(). Throws Failure(Memory). */
MaskSurface
MaskToSurface(const MaskPiece & piece, const MaskSurfaceSettings & settings);

} // namespace rhombic

#endif
