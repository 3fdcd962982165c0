#include "rhombicVoxelDecoding.h"

#include "rhombicDicomDecoding.h"
#include "rhombicVolumeVoxels.h"

namespace rhombic
{

void
DecodeVoxels(const VoxelRequest & request, std::byte * voxels)
{
  switch (request.source)
  {
    case VoxelRequest::Source::DicomFile:
      DecodeDicomFile(request.path, voxels, request.size);
      break;
    case VoxelRequest::Source::VolumeFile:
      DecodeVolumeFile(request.path, voxels, request.size);
      break;
  }
}

} // namespace rhombic
