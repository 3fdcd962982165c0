#ifndef rhombicPatientAxes_h
#define rhombicPatientAxes_h

#include "rhombicScan.h"

#include "itkProcessObject.h"

#include <cstdint>
#include <filesystem>

namespace rhombic
{

/** The scan with its axes in the order of the patient's: the first runs nearest to right-left, the second to
 * anterior-posterior, the third to inferior-superior, each towards +LPS. Samples keep their positions, so that the same
 * volume gives the same lattice whatever the order of its axes in the file. The voxels are copied only if axes change.
 * Slanted scans keep the order of their slices. Of a scan without voxels only the geometry changes. Copies that do not
 * fit are made in a temporary file (AllocateInTemporaryFile()). Throws Failure(Memory), before any work, when there is
 * no room for it. \param maximumMemory bytes for the copies; 0: half of the free memory
 * \param temporaryFolder as ScanReadOptions has it */
Scan
OrderAlongPatient(const Scan & scan,
                  std::uintmax_t maximumMemory = 0,
                  const std::filesystem::path & temporaryFolder = {});

/** An image whose third axis is the one that work goes on along, plane by plane. */
struct DeepImage
{
  ScanImage image;
  itk::ProcessObject::Pointer source; ///< makes its voxels when they are asked for; null where it has them
};

/** The image, or, where its slices are few and larger than 8 million voxels, an image with its second and third axes
 * exchanged: then planes of constant third index are small, and so is a slab with the planes around it. Samples keep
 * their positions. That follows from the size alone, so that what is made of the image does not depend on the memory.
 */
DeepImage
MakeDeep(const ScanImage & image);

} // namespace rhombic

#endif
