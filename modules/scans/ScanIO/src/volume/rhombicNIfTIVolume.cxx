#include "rhombicStoredVolume.h"

#include "rhombicCompressedFile.h"
#include "rhombicNIfTIHeader.h"
#include "rhombicVolumeRefusal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

/** The file beside \a path with the first possible extension; an empty path when there is none. */
fs::path
Partner(const fs::path & path, std::initializer_list<const char *> extensions)
{
  const std::string name = path.filename().string();
  const std::string stem = name.substr(0, name.size() - VolumeExtension(path).size());
  for (const char * const extension : extensions)
  {
    const fs::path partner = path.parent_path() / (stem + extension);
    std::error_code error;
    if (fs::is_regular_file(partner, error))
    {
      return partner;
    }
  }
  return {};
}

/** Whether the extension is that of a part of a pair of files, \a part, or of its compressed form. */
bool
IsNamedAs(const fs::path & path, const std::string & part)
{
  const std::string extension = VolumeExtension(path);
  return extension == part || extension == part + ".gz";
}

fs::path
HeaderFile(const fs::path & path)
{
  if (!IsNamedAs(path, ".img"))
  {
    return path;
  }
  const fs::path header = Partner(path, { ".hdr", ".HDR", ".hdr.gz", ".HDR.GZ" });
  RefuseOtherIf(header.empty(),
                path,
                "its header should be in an .hdr file beside it, which is missing; put the two into one folder");
  return header;
}

/** The file that holds the voxels of the header file \a path. */
fs::path
VoxelsFile(const fs::path & path, const NIfTIHeader & header, const ScanReadOptions & options)
{
  const bool isNamedAsPair = IsNamedAs(path, ".hdr");
  RefuseVolumeIf(header.kind == NIfTIHeader::Kind::Analyze &&
                   !(options.acceptsAnalyze && isNamedAsPair && header.version == 1),
                 path,
                 "it is an Analyze 7.5 file or a damaged NIfTI file (its magic word is missing), whose orientation is "
                 "unknown; convert it to NIfTI, or have it read with ScanReadOptions::acceptsAnalyze");
  RefuseVolumeIf((header.kind == NIfTIHeader::Kind::SingleFile) == isNamedAsPair,
                 path,
                 isNamedAsPair ? "its header says that the voxels follow in the same file; rename it to .nii"
                               : "its header says that the voxels are in an .img file; rename it to .hdr");
  if (!isNamedAsPair)
  {
    return path;
  }
  const fs::path voxels = Partner(path, { ".img", ".IMG", ".img.gz", ".IMG.GZ" });
  RefuseVolumeIf(voxels.empty(),
                 path,
                 "its voxels should be in an .img file beside it, which is missing; put the two into one folder");
  return voxels;
}

/** The three sizes of a volume and the number of volumes: the product of the dimensions after the third. */
std::array<std::uintmax_t, 4>
SizesOf(const NIfTIHeader & header, const fs::path & path)
{
  const std::int64_t count = header.dimensions[0];
  const std::string isNoVolume =
    "it has " + std::to_string(count) + (count == 1 ? " dimension" : " dimensions") + "; a volume has three";
  RefuseOtherIf(count == 1 || count == 2, path, isNoVolume);
  RefuseVolumeIf(count < 3 || count > 7, path, isNoVolume);
  std::vector<std::uintmax_t> frames;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(count); ++i)
  {
    const std::int64_t size = header.dimensions[i];
    RefuseVolumeIf(size < 1,
                   path,
                   "its size along axis " + std::to_string(i - 1) + " is " + std::to_string(size) +
                     "; export it again from its source");
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
  static const std::map<int, StoredType> types{ { 2, std::uint8_t() },    { 4, std::int16_t() },
                                                { 8, std::int32_t() },    { 16, float() },
                                                { 64, double() },         { 256, std::int8_t() },
                                                { 512, std::uint16_t() }, { 768, std::uint32_t() },
                                                { 1024, std::int64_t() }, { 1280, std::uint64_t() } };
  static const std::map<int, std::string> refused{ { 1, "single bits" },        { 32, "complex numbers" },
                                                   { 128, "RGB colours" },      { 1536, "128-bit numbers" },
                                                   { 1792, "complex numbers" }, { 2048, "complex numbers" },
                                                   { 2304, "RGBA colours" } };
  const std::string datatype = std::to_string(header.datatype);
  if (const auto found = refused.find(header.datatype); found != refused.end())
  {
    RefuseOther(path, "its voxels are " + found->second + "; convert them to integers or floats first");
  }
  const auto found = types.find(header.datatype);
  RefuseVolumeIf(found == types.end(),
                 path,
                 "its pixel type (datatype " + datatype + ") is unknown; export it again from its source");
  RefuseVolumeIf(header.bits != static_cast<int>(8 * SizeOf(found->second)),
                 path,
                 "its header contradicts itself about the bits of a voxel (datatype " + datatype + ", bitpix " +
                   std::to_string(header.bits) + "); export it again from its source");
  return found->second;
}

void
RefuseVectors(const NIfTIHeader & header, const fs::path & path)
{
  const int intent = header.intent;
  const bool isMatrixToQuaternion = intent >= 1004 && intent <= 1010;
  const bool isColour = intent == 2003 || intent == 2004;
  RefuseOtherIf(isMatrixToQuaternion || isColour,
                path,
                "its voxels are vectors, matrices or colours (intent " + std::to_string(intent) +
                  "); extract one component first");
}

/** The scaling of values; nothing for a slope of 0 or NaN, which means no scaling, and for slope 1 and intercept 0. */
std::optional<ValueScaling>
ScalingOf(const NIfTIHeader & header, const fs::path & path)
{
  const double slope = header.slope;
  const double intercept = header.intercept;
  const bool isScaled = slope != 0 && !std::isnan(slope);
  RefuseVolumeIf(std::isinf(slope) || std::isinf(intercept) || (isScaled && std::isnan(intercept)),
                 path,
                 "its scaling of values (scl_slope, scl_inter) makes no sense; export it again from its source");
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
  RefuseVolumeIf(!(header.voxelsOffset >= smallest && header.voxelsOffset <= largest) ||
                   header.voxelsOffset != std::floor(header.voxelsOffset),
                 path,
                 "its header says that the voxels begin where they can't (vox_offset); export it again from its "
                 "source");
  return static_cast<std::uintmax_t>(header.voxelsOffset);
}

using Affine = std::array<itk::Vector<double, 3>, 4>; ///< the steps along three axes and the origin, in RAS

double
MillimetresPerUnit(const NIfTIHeader & header)
{
  constexpr int metre = 1, micrometre = 3;
  const int unit = header.units & 7;
  return unit == metre ? 1e3 : unit == micrometre ? 1e-3 : 1.0;
}

void
CheckPixdim(const NIfTIHeader & header, const fs::path & path)
{
  for (std::size_t axis = 1; axis <= 3; ++axis)
  {
    if (!std::isfinite(header.pixdim[axis]) || header.pixdim[axis] <= 0)
    {
      RefuseGeometry(path,
                     "its voxels have no proper size along axis " + std::to_string(axis - 1) + " (pixdim is " +
                       std::to_string(header.pixdim[axis]) + "); export it again from its source");
    }
  }
}

Affine
Sform(const NIfTIHeader & header)
{
  Affine affine;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int column = 0; column < 4; ++column)
    {
      affine[column][row] = header.sform[row][column];
    }
  }
  return affine;
}

/** The affine of the quaternion, as nifti1.h defines it. */
Affine
Qform(const NIfTIHeader & header, const fs::path & path)
{
  auto [b, c, d] = header.quaternion;
  const double squares = b * b + c * c + d * d;
  constexpr double tolerance = 1e-3;
  RefuseGeometryIf(!std::isfinite(squares) || !std::isfinite(header.pixdim[0]) || squares > 1 + tolerance,
                   path,
                   "its qform holds a quaternion that is no rotation; export it again from its source");
  const bool isHalfTurn = 1 - squares < 1e-7; // the tolerance of nifti1_io.c
  const double norm = isHalfTurn ? std::sqrt(squares) : 1.0;
  b /= norm;
  c /= norm;
  d /= norm;
  const double a = isHalfTurn ? 0.0 : std::sqrt(1 - squares);
  const double rotation[3][3] = {
    { a * a + b * b - c * c - d * d, 2 * b * c - 2 * a * d, 2 * b * d + 2 * a * c },
    { 2 * b * c + 2 * a * d, a * a + c * c - b * b - d * d, 2 * c * d - 2 * a * b },
    { 2 * b * d - 2 * a * c, 2 * c * d + 2 * a * b, a * a + d * d - c * c - b * b },
  };
  const double handedness = header.pixdim[0] < 0 ? -1 : 1;
  Affine affine;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      affine[axis][row] = rotation[row][axis] * header.pixdim[axis + 1] * (axis == 2 ? handedness : 1);
    }
    affine[3][row] = header.qformOffset[row];
  }
  return affine;
}

/** An affine along the LPS axes, which ITK and most viewers use for files without an orientation. */
Affine
Unoriented(const NIfTIHeader & header)
{
  Affine affine{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    affine[axis][axis] = header.pixdim[axis + 1] * (axis == 2 ? 1 : -1);
  }
  return affine;
}

/** The largest distance between the positions of a corner of the volume by two affines. */
double
CornerDistance(const Affine & first, const Affine & second, const itk::Size<3> & size)
{
  double largest = 0;
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    itk::Vector<double, 3> difference = first[3] - second[3];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double index = (corner >> axis & 1) != 0 ? static_cast<double>(size[axis] - 1) : 0.0;
      difference += (first[axis] - second[axis]) * index;
    }
    largest = std::max(largest, difference.GetNorm());
  }
  return largest;
}

bool
HasSteps(const Affine & affine, const NIfTIHeader & header)
{
  constexpr double tolerance = 1e-3;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(affine[axis].GetNorm() - header.pixdim[axis + 1]) > tolerance * header.pixdim[axis + 1])
    {
      return false;
    }
  }
  return true;
}

VolumeGeometry
ToLPSMillimetres(Affine affine, double millimetresPerUnit, const itk::Size<3> & size)
{
  for (auto & step : affine)
  {
    step *= millimetresPerUnit;
    step[0] = -step[0];
    step[1] = -step[1];
  }
  itk::Point<double, 3> origin;
  origin.Fill(0);
  return MakeGeometry(size, origin + affine[3], affine.data());
}

/** The geometry of a NIfTI volume: by the sform if its code is set, else by the qform, else along the LPS axes from the
 * origin. Fills affine, isOriented and notes of \a scan. Throws Failure(Geometry) when numbers are not finite, voxels
 * have no size or axes lie in one plane; another affine of the file is never used instead. */
VolumeGeometry
PlaceNIfTIVolume(const NIfTIHeader & header,
                 const itk::Size<3> & size,
                 const fs::path & path,
                 ScanReadOptions::Policy onSheared,
                 Scan & scan)
{
  const bool isAnalyze =
    header.kind == NIfTIHeader::Kind::Analyze; // its header has other fields where NIfTI has the codes
  const bool hasSform = !isAnalyze && header.sformCode > 0;
  const bool hasQform = !isAnalyze && header.qformCode > 0;
  const double millimetresPerUnit = isAnalyze ? 1.0 : MillimetresPerUnit(header);
  CheckPixdim(header, path);

  AffineReport report;
  report.source = hasSform ? "sform" : hasQform ? "qform" : "none";
  const Affine affine = hasSform ? Sform(header) : hasQform ? Qform(header, path) : Unoriented(header);
  const VolumeGeometry geometry = ToLPSMillimetres(affine, millimetresPerUnit, size);
  CheckGeometry(geometry, path, hasSform || hasQform ? report.source : "pixdim", onSheared, scan.notes);

  if (!hasSform && !hasQform)
  {
    scan.isOriented = false;
    scan.notes.push_back(path.string() + " does not say how it lies in the patient; left and right are a guess.");
  }
  else if (hasSform && hasQform)
  {
    const double distance = CornerDistance(affine, Qform(header, path), size);
    RefuseGeometryIf(
      !std::isfinite(distance), path, "its qform holds numbers that are not finite; export it again from its source");
    report.disagreement = distance * millimetresPerUnit;
    constexpr double tolerance = 1e-2; // relative to a voxel: quaternions are rounded
    if (distance > tolerance * std::min({ affine[0].GetNorm(), affine[1].GetNorm(), affine[2].GetNorm() }))
    {
      scan.notes.push_back(path.string() + " gives two positions in the patient, up to " +
                           std::to_string(report.disagreement) + " mm apart; its sform was used, not its qform.");
    }
  }
  else if (hasSform && !HasSteps(affine, header))
  {
    scan.notes.push_back(path.string() +
                         " gives two sizes for its voxels; that of its sform was used, not that of pixdim.");
  }
  scan.affine = report;
  return geometry;
}

} // namespace

StoredVolume
ReadNIfTIVolume(const fs::path & path, const ScanReadOptions & options, Scan & scan)
{
  const fs::path headerFile = HeaderFile(path);
  const auto found = FindNIfTIHeader(headerFile);
  if (!found)
  {
    const auto refuse = IsNamedAs(headerFile, ".hdr") ? RefuseOther : RefuseVolume; // others have .hdr files, too
    refuse(headerFile, "its content is not NIfTI, as its name says; check where it came from");
  }
  const NIfTIHeader & header = *found;
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
