#ifndef rhombicThickMaps_h
#define rhombicThickMaps_h

#include "rhombicVector3.h"

#include "itkImage.h"

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Label maps as people draw them: slice by slice, on slices much thicker than a pixel. */

/** A structure of a thick map. */
struct ThickStructure
{
  std::string name;
  std::function<double(const Vector3 &)> depth; ///< below its surface in mm, negative outside; exact
  std::array<Vector3, 2> box;                   ///< corners of a box around it, in mm
  bool standsAlone; ///< whether no other structure reaches it, so that its depth is the truth of its label
  bool isVessel;    ///< 1 to 3 pixels thick: its pixels are not flipped
};

/** Eleven structures around the origin in 300 x 250 x 445 mm: liver, spleen, two kidneys and aorta, vessels 1, 2 and 3
 * pixels thick (the first so thick that each slice has a pixel of it), and stomach, pancreas and duodenum, which touch.
 * The label of structure n is n + 1. */
std::vector<ThickStructure>
MakeThickStructures();

/** The grid of a thick map, and how unsteady the hand is. */
struct ThickMapSettings
{
  std::array<double, 3> spacing{ 0.78125, 0.78125, 5.0 };
  std::array<unsigned int, 3> size{ 384, 320, 89 };
  double sway = 0.5;          ///< largest shift of a border in a slice along each axis, in pixels, smooth along it
  double flippedShare = 0.05; ///< of the pixels at borders: each gets the label of a pixel beside it
  unsigned int seed = 1;
};

/** The map of some structures: at each voxel's centre the label of the structure that is deepest there, or 0. In each
 * slice, borders are shifted by a smooth random field, and some of their pixels are flipped. The same for each run. */
itk::Image<std::uint16_t, 3>::Pointer
MakeThickMap(const std::vector<ThickStructure> & structures, const ThickMapSettings & settings = {});

} // namespace rhombic

#endif
