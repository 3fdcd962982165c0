#include "rhombicSurfaceIO.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicPLYWriter.h"
#include "rhombicSTLWriter.h"
#include "rhombicVTPWriter.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <limits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

struct SurfaceFormat
{
  const char * extension;
  /** Writes the file and returns the size in bytes that it must have. */
  std::uintmax_t (*write)(const itk::TriangleSurface & surface, const fs::path & path);
};

constexpr std::array<SurfaceFormat, 3> SurfaceFormats{
  { { ".stl", WriteSTL }, { ".ply", WritePLY }, { ".vtp", WriteVTP } }
};

const SurfaceFormat &
FormatOf(const fs::path & path)
{
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char letter) {
    return static_cast<char>(std::tolower(letter));
  });
  for (const SurfaceFormat & format : SurfaceFormats)
  {
    if (extension == format.extension)
    {
      return format;
    }
  }
  throw Failure(FailureKind::Usage,
                "Cannot write " + path.string() + ": its extension names no surface format; use one of " +
                  GetSurfaceFileExtensions() + ".");
}

void
CheckSize(const itk::TriangleSurface & surface, const fs::path & path)
{
  if (surface.GetNumberOfTriangles() == 0)
  {
    throw Failure(FailureKind::Empty,
                  "Nothing to write to " + path.string() + ": the surface has no triangles; try another isovalue.");
  }
  constexpr itk::SizeValueType largestIndex = std::numeric_limits<std::int32_t>::max();
  if (surface.GetNumberOfPoints() > largestIndex || 3 * surface.GetNumberOfTriangles() > largestIndex)
  {
    throw Failure(FailureKind::Output,
                  "Cannot write " + path.string() + ": " + std::to_string(surface.GetNumberOfTriangles()) +
                    " triangles are more than the format's 32-bit indices reach; extract at a lower density.");
  }
}

} // namespace

std::string
GetSurfaceFileExtensions()
{
  std::string list;
  for (const SurfaceFormat & format : SurfaceFormats)
  {
    list += (list.empty() ? "" : ", ") + std::string(format.extension);
  }
  return list;
}

void
CheckSurfacePath(const fs::path & path)
{
  FormatOf(path);
}

void
WriteSurface(const itk::TriangleSurface & surface, const fs::path & path)
{
  const SurfaceFormat & format = FormatOf(path);
  CheckSize(surface, path);
  AtomicFile file(path);
  const std::uintmax_t size = format.write(surface, file.GetTemporaryPath());

  std::error_code error;
  const std::uintmax_t written = fs::file_size(file.GetTemporaryPath(), error);
  if (error || written != size)
  {
    throw Failure(FailureKind::Output,
                  "Cannot write " + path.string() + ": " + std::to_string(error ? 0 : written) + " of " +
                    std::to_string(size) + " bytes arrived; is the disk full?");
  }
  file.Commit(size);
}

} // namespace rhombic
