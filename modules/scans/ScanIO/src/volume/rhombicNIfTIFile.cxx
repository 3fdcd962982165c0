#include "rhombicNIfTIFile.h"

#include "rhombicCompressedFile.h"
#include "rhombicNIfTIAffine.h"
#include "rhombicNIfTIHeader.h"
#include "rhombicVolumeFormat.h"
#include "rhombicVolumeFrame.h"
#include "rhombicVolumeRefusal.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** The file beside \a path with one of two extensions, in upper or lower case; an empty path when there is none. */
fs::path
Partner(const fs::path & path, const std::string & extension, const std::string & compressedExtension)
{
  const std::string name = path.filename().string();
  const std::string stem = name.substr(0, name.size() - VolumeExtension(path).size());
  for (std::string end : { extension, compressedExtension })
  {
    for (const bool isUpperCase : { false, true })
    {
      if (isUpperCase)
      {
        std::transform(end.begin(), end.end(), end.begin(), [](unsigned char letter) {
          return static_cast<char>(std::toupper(letter));
        });
      }
      const fs::path partner = path.parent_path() / (stem + end);
      std::error_code error;
      if (fs::is_regular_file(partner, error))
      {
        return partner;
      }
    }
  }
  return {};
}

bool
IsOneOf(const std::string & extension, const char * first, const char * second)
{
  return extension == first || extension == second;
}

fs::path
HeaderFile(const fs::path & path)
{
  if (!IsOneOf(VolumeExtension(path), ".img", ".img.gz"))
  {
    return path;
  }
  const fs::path header = Partner(path, ".hdr", ".hdr.gz");
  if (header.empty())
  {
    RefuseVolume(path, "its header should be in an .hdr file beside it, which is missing; put the two into one folder");
  }
  return header;
}

/** The file that holds the voxels of the header file \a path. */
fs::path
VoxelsFile(const fs::path & path, const NIfTIHeader & header, const ScanReadOptions & options)
{
  const bool isNamedAsPair = IsOneOf(VolumeExtension(path), ".hdr", ".hdr.gz");
  if (header.kind == NIfTIHeader::Kind::Analyze && !(options.acceptsAnalyze && isNamedAsPair && header.version == 1))
  {
    RefuseVolume(path,
                 "it is an Analyze 7.5 file or a damaged NIfTI file (its magic word is missing), whose orientation is "
                 "unknown; convert it to NIfTI, or have it read with --analyze");
  }
  if ((header.kind == NIfTIHeader::Kind::SingleFile) == isNamedAsPair)
  {
    RefuseVolume(path,
                 isNamedAsPair ? "its header says that the voxels follow in the same file; rename it to .nii"
                               : "its header says that the voxels are in an .img file; rename it to .hdr");
  }
  if (!isNamedAsPair)
  {
    return path;
  }
  const fs::path voxels = Partner(path, ".img", ".img.gz");
  if (voxels.empty())
  {
    RefuseVolume(path, "its voxels should be in an .img file beside it, which is missing; put the two into one folder");
  }
  return voxels;
}

/** The three sizes of a volume and the number of volumes: the product of the dimensions after the third. */
std::array<std::uintmax_t, 4>
SizesOf(const NIfTIHeader & header, const fs::path & path)
{
  const std::int64_t count = header.dimensions[0];
  if (count < 3 || count > 7)
  {
    RefuseVolume(
      path, "it has " + std::to_string(count) + (count == 1 ? " dimension" : " dimensions") + "; a volume has three");
  }
  std::vector<std::uintmax_t> frames;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(count); ++i)
  {
    const std::int64_t size = header.dimensions[i];
    if (size < 1)
    {
      RefuseVolume(path,
                   "its size along axis " + std::to_string(i - 1) + " is " + std::to_string(size) +
                     "; export it again from its source");
    }
    if (i > 3)
    {
      frames.push_back(static_cast<std::uintmax_t>(size));
    }
  }
  const auto numberOfFrames = ProductOf(frames);
  if (!numberOfFrames)
  {
    RefuseVolume(path, "its dimensions are larger than any volume; export it again from its source");
  }
  return { static_cast<std::uintmax_t>(header.dimensions[1]),
           static_cast<std::uintmax_t>(header.dimensions[2]),
           static_cast<std::uintmax_t>(header.dimensions[3]),
           *numberOfFrames };
}

/** The type of the voxels. Throws Failure for voxels that are not single numbers. */
StoredType
TypeOf(const NIfTIHeader & header, const fs::path & path)
{
  struct Datatype
  {
    int code;
    int bits;
    StoredType type;
  };
  static constexpr std::array<Datatype, 10> datatypes{ {
    { 2, 8, StoredType::UInt8 },
    { 4, 16, StoredType::Int16 },
    { 8, 32, StoredType::Int32 },
    { 16, 32, StoredType::Float },
    { 64, 64, StoredType::Double },
    { 256, 8, StoredType::Int8 },
    { 512, 16, StoredType::UInt16 },
    { 768, 32, StoredType::UInt32 },
    { 1024, 64, StoredType::Int64 },
    { 1280, 64, StoredType::UInt64 },
  } };
  struct Refused
  {
    int code;
    const char * name;
  };
  static constexpr std::array<Refused, 7> refused{ { { 1, "single bits" },
                                                     { 32, "complex numbers" },
                                                     { 1792, "complex numbers" },
                                                     { 2048, "complex numbers" },
                                                     { 128, "RGB colours" },
                                                     { 2304, "RGBA colours" },
                                                     { 1536, "128-bit numbers" } } };

  const auto hasCode = [&header](const auto & entry) { return entry.code == header.datatype; };
  if (const auto * const found = std::find_if(refused.begin(), refused.end(), hasCode); found != refused.end())
  {
    RefuseVolume(path, std::string("its voxels are ") + found->name + "; convert them to integers or floats first");
  }
  const auto * const found = std::find_if(datatypes.begin(), datatypes.end(), hasCode);
  if (found == datatypes.end())
  {
    RefuseVolume(path,
                 "its pixel type (datatype " + std::to_string(header.datatype) +
                   ") is unknown; export it again from its source");
  }
  if (header.bits != found->bits)
  {
    RefuseVolume(path,
                 "its header contradicts itself about the bits of a voxel (datatype " +
                   std::to_string(header.datatype) + ", bitpix " + std::to_string(header.bits) +
                   "); export it again from its source");
  }
  return found->type;
}

void
RefuseVectors(const NIfTIHeader & header, const fs::path & path)
{
  const int intent = header.intent;
  const bool isMatrixToQuaternion = intent >= 1004 && intent <= 1010;
  const bool isColour = intent == 2003 || intent == 2004;
  if (isMatrixToQuaternion || isColour)
  {
    RefuseVolume(path,
                 "its voxels are vectors, matrices or colours (intent " + std::to_string(intent) +
                   "); extract one component first");
  }
}

/** The scaling of values; nothing for a slope of 0 or NaN, which means no scaling, and for slope 1 and intercept 0. */
std::optional<ValueScaling>
ScalingOf(const NIfTIHeader & header, const fs::path & path)
{
  const double slope = header.slope;
  const double intercept = header.intercept;
  const bool isScaled = slope != 0 && !std::isnan(slope);
  if (std::isinf(slope) || std::isinf(intercept) || (isScaled && std::isnan(intercept)))
  {
    RefuseVolume(path, "its scaling of values (scl_slope, scl_inter) makes no sense; export it again from its source");
  }
  if (!isScaled || (slope == 1 && intercept == 0))
  {
    return std::nullopt;
  }
  return ValueScaling{ slope, intercept };
}

std::uintmax_t
VoxelsOffset(const NIfTIHeader & header, const fs::path & path)
{
  const double smallest = header.kind != NIfTIHeader::Kind::SingleFile ? 0 : header.version == 1 ? 352 : 544;
  constexpr double largest = 1e15;
  if (!(header.voxelsOffset >= smallest && header.voxelsOffset <= largest) ||
      header.voxelsOffset != std::floor(header.voxelsOffset))
  {
    RefuseVolume(path,
                 "its header says that the voxels begin where they can't (vox_offset); export it again from its "
                 "source");
  }
  return static_cast<std::uintmax_t>(header.voxelsOffset);
}

} // namespace

StoredVolume
ReadNIfTIVolume(const fs::path & path, const ScanReadOptions & options, Scan & scan)
{
  const fs::path headerFile = HeaderFile(path);
  const NIfTIHeader header = ReadNIfTIHeader(headerFile);
  const bool isAnalyze = header.kind == NIfTIHeader::Kind::Analyze;
  StoredVolume volume;
  volume.voxels.path = VoxelsFile(headerFile, header, options);
  const auto sizes = SizesOf(header, headerFile);
  volume.numberOfFrames = sizes[3];
  volume.type = TypeOf(header, headerFile);
  if (!isAnalyze)
  {
    RefuseVectors(header, headerFile);
    volume.scaling = ScalingOf(header, headerFile);
  }
  volume.voxels.skip = VoxelsOffset(header, headerFile);
  volume.voxels.isDeflated = IsGzip(volume.voxels.path);
  volume.voxels.isSwapped = header.isSwapped;
  volume.encoding = volume.voxels.isDeflated ? "gzip" : "raw";
  RequireVoxels({ sizes.begin(), sizes.end() }, false, headerFile, volume);
  volume.geometry = PlaceNIfTIVolume(header, { { sizes[0], sizes[1], sizes[2] } }, headerFile, options.onTilted, scan);
  volume.isOriented = scan.isOriented;
  volume.note = isAnalyze ? "is an Analyze 7.5 file; its voxels' sizes were used, and no scaling of values" : "";
  return volume;
}

} // namespace rhombic
