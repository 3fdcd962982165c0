#ifndef rhombicUnpackDicom_h
#define rhombicUnpackDicom_h

#include "rhombicDicomFrames.h"
#include "rhombicSandbox.h"

namespace rhombictest
{

/** The pixels of the first frame of a compressed DICOM file, from a child process. Throws Failure. */
inline std::string
UnpackFirstFrame(const std::filesystem::path & path)
{
  const auto slices = rhombic::ReadDicomSlices(path);
  const rhombic::DicomImageFile & file = *slices.at(0).file;
  rhombic::SandboxRun run({ rhombic::DicomHelper, path, nlohmann::json(file).dump(), file.format.FrameBytes() });
  const auto piece = run.Next();
  return { reinterpret_cast<const char *>(piece.value().data), piece.value().size };
}

} // namespace rhombictest

#endif
