#ifndef rhombicPhantom_h
#define rhombicPhantom_h

#include "itkImage.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * A made-up body, and its CT. Thread safety: the structs are values; the functions say their own. */

/** A point in LPS millimetres: x towards the patient's left, y to the back, z to the head. */
using PhantomPoint = std::array<double, 3>;

/** What is known of one organ of the phantom. */
struct PhantomOrgan
{
  std::string name;            ///< lower-case words
  int label;                   ///< its value in the label image, from 1
  double hounsfield;           ///< of the whole organ
  double volume;               ///< exact, in mm^3, without what lies inside it and is another organ
  std::array<float, 3> colour; ///< red, green and blue of sRGB, 0..1
};

/** The organs by label, without the air around the body (label 0, -1000 HU). Thread safe. */
const std::vector<PhantomOrgan> &
PhantomOrgans();

/** How the phantom is sampled. */
struct PhantomSettings
{
  double spacing = 2.0; ///< between samples along each axis, in mm, 0.5 to 10
};

using PhantomScan = itk::Image<std::int16_t, 3>;
using PhantomLabels = itk::Image<std::uint8_t, 3>;

/** The label of a point; points on a border belong to the inner organ. Thread safe. */
int
PhantomLabelAt(const PhantomPoint & point);

/** The ideal, unsampled CT in Hounsfield units: -1000 in the air, otherwise that of the organ at the point.
 * Thread safe. */
double
PhantomHounsfieldAt(const PhantomPoint & point);

/** What a surface at a threshold encloses. */
struct PhantomEnclosure
{
  std::vector<int> labels; ///< the organs inside, ascending
  double volume;           ///< exact, in mm^3, of all points where the ideal CT is at least the threshold
};

/** What the isosurface at \a threshold, in Hounsfield units, encloses: 250.5 the bones, the teeth and the marker;
 * -300.5 everything but the lungs and the airway. A sampled scan's surface lies at the ideal place where the threshold
 * is the mean of the two tissues; elsewhere it is off by a fraction of the spacing. Throws Failure(Usage) for
 * thresholds that the air around the body reaches (-1000 and less), or that are no numbers. Thread safe. */
PhantomEnclosure
PhantomEnclosedBy(double threshold);

/** The CT in Hounsfield units; axes along LPS, air all around the body. Each voxel is the average of the ideal CT over
 * a cube about its centre, rounded. As in a scanner, cubes overlap: their side is twice the spacing, but at most 4 mm,
 * and at least the spacing. Between two tissues, the surface at the mean of both is then where it should be to a few
 * hundredths of the spacing. The same voxels for any number of threads. Throws Failure(Usage) for a spacing out of
 * range, Failure(Memory). Thread safe. */
PhantomScan::Pointer
MakePhantomScan(const PhantomSettings & settings = {});

/** The label at each voxel's centre, on the grid of MakePhantomScan(). Throws as it does. Thread safe. */
PhantomLabels::Pointer
MakePhantomLabels(const PhantomSettings & settings = {});

} // namespace rhombic

#endif
