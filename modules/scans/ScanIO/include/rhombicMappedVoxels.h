#ifndef rhombicMappedVoxels_h
#define rhombicMappedVoxels_h

#include "rhombicMappedPages.h"
#include "rhombicScan.h"

#include <filesystem>

namespace rhombic
{

/** Where the voxels of a scan are. */
enum class VoxelPlace
{
  Memory,
  File,         ///< mapped: their file
  TemporaryFile ///< mapped: a temporary file without a name
};

/** Whether the voxels of a scan are pages of a file, which the system reads when they are used and drops when memory
 * is short, so that they take none of the memory that work may have. ReadVoxels() maps a file when its voxels would
 * take more than half of ScanReadOptions::maximumMemory and can be used as the file holds them: raw, not scaled, in
 * this machine's byte order, at a multiple of their size, and of a type that ScanImage has. Changed voxels are copies
 * in memory; the file stays as it is. Others of more than half of it are put into a temporary file while they are read,
 * see FindPlaceToRead(); a compressed stream of more than all of it is refused. */
bool
IsMapped(const ScanImage & image);

/** The same, and which file it is. */
VoxelPlace
PlaceOf(const ScanImage & image);

/** Temporary files for the voxels of \a scan. */
TemporaryStore
VoxelStore(const std::filesystem::path & scan, const std::filesystem::path & folder);

/** Where voxels will be that can't be mapped in their file: in memory up to half of what is allowed, as the other half
 * is for what is made of them, else in a temporary file. Where there is no room for one they are in memory if they fit.
 * \param working bytes that reading needs besides. Throws Failure(Memory) where they fit nowhere. */
VoxelPlace
FindPlaceToRead(const TemporaryStore & store,
                std::uintmax_t bytes,
                std::uintmax_t working,
                std::uintmax_t maximumMemory);

/** Allocates the pixels of the largest possible region in a temporary file without a name. It goes away with the image.
 * Pixels are 0. Throws Failure(Memory) when there is no room. */
void
AllocateInTemporaryFile(const ScanImage & image, const TemporaryStore & store);

/** Takes the pages of a mapped image that are in memory out of the process, and drops them if the file is larger than
 * the free memory: for work that goes on elsewhere in the image, so that they do not count as memory of the process or
 * of its control group. Changed voxels are kept. Without effect on other images. Not while another thread writes
 * voxels. */
void
DropPages(const ScanImage & image);

} // namespace rhombic

#endif
