#ifndef rhombicPhantomFiles_h
#define rhombicPhantomFiles_h

#include "rhombicPhantom.h"

#include <filesystem>

namespace rhombic
{

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
