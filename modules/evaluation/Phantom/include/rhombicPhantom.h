#ifndef rhombicPhantom_h
#define rhombicPhantom_h

#include "itkImage.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * A made-up body of known volumes, and its CT. */

/** A point in LPS millimetres: x towards the patient's left, y to the back, z to the head. */
using PhantomPoint = std::array<double, 3>;

/** One organ of the phantom. */
struct PhantomOrgan
{
  std::string name;            ///< in lower case
  int label;                   ///< its value in the label image, from 1
  double hounsfield;           ///< the value of the whole organ, in Hounsfield units
  double volume;               ///< exact, in mm^3, without other organs that lie inside
  std::array<float, 3> colour; ///< red, green and blue of sRGB, 0 to 1
};

/** The organs in the order of their labels. The air around the body, label 0 and -1000 HU, is not among them. */
const std::vector<PhantomOrgan> &
PhantomOrgans();

/** The label at a point; points on a border belong to the inner organ. */
int
PhantomLabelAt(const PhantomPoint & point);

/** The organs and the volume that a surface at a threshold encloses. */
struct PhantomEnclosure
{
  std::vector<int> labels; ///< the organs inside, ascending
  double volume;           ///< exact, in mm^3
};

/** All organs whose value is at least \a threshold, in Hounsfield units: at 250.5 the bones, the teeth and the marker;
 * at -300.5 everything but the lungs and the airway. The isosurface of a sampled scan lies on the organs' border where
 * the threshold is the mean of the values on both sides; elsewhere it is off by a fraction of the spacing. Throws
 * Failure(Usage) for thresholds that are not above -1000. */
PhantomEnclosure
PhantomEnclosedBy(double threshold);

/** The grid of a phantom's scan. */
struct PhantomSettings
{
  double spacing = 2.0; ///< distance of samples along each axis, in mm, 0.5 to 10
};

using PhantomScan = itk::Image<std::int16_t, 3>;
using PhantomLabels = itk::Image<std::uint8_t, 3>;

/** The CT in Hounsfield units, with axes along LPS and air all around the body.
 *
 * Each voxel is the rounded average over a cube about its centre. As in a scanner, cubes overlap: their side is twice
 * the spacing, but at most 4 mm, and at least the spacing. So the surface at the mean of two tissues is off by a few
 * hundredths of the spacing only. The voxels do not depend on the number of threads. Throws Failure: Usage for a
 * spacing out of range, Memory. */
PhantomScan::Pointer
MakePhantomScan(const PhantomSettings & settings = {});

/** The label at each voxel's centre, on the grid of MakePhantomScan(), with its exceptions. */
PhantomLabels::Pointer
MakePhantomLabels(const PhantomSettings & settings = {});

/** Writes the phantom into \a folder, the same bytes every time:
 *
 * - `dicom/`: a CT series, one file a slice, from the feet up; patient PHANTOM, fixed identifiers, no dates;
 * - `phantom.nii.gz`: the same scan, int16 in Hounsfield units;
 * - `phantom-labels.nii.gz`: its labels, uint8;
 * - `phantom-labels.tsv`: names and colours of the labels;
 * - `phantom-organs.csv`: name, label, Hounsfield units, exact volume in ml and colour of each organ.
 *
 * The folder is created, but not those above it. The files appear together at the end: a failure leaves the folder as
 * it was. Throws Failure(Output) for a folder that is not empty, whose parent is missing, or that can't be written; and
 * as MakePhantomScan() does. */
void
WritePhantom(const std::filesystem::path & folder, const PhantomSettings & settings = {});

} // namespace rhombic

#endif
