#include "rhombicVoxelDecoding.h"

#include "rhombicDicomDecoding.h"

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
      break;
  }
}

} // namespace rhombic
