#include "rhombicStoredVolume.h"

#include "rhombicTextHeader.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include "itkByteSwapper.h"

#include <cmath>
#include <fstream>
#include <map>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

bool
IsTrue(const TextHeader & header, const char * field)
{
  const std::string value = header.Get(field);
  return !value.empty() && (value.front() == 'T' || value.front() == 't' || value.front() == '1');
}

/** The lines up to that of ElementDataFile. */
TextHeader
ReadHeader(const fs::path & path)
{
  constexpr std::uintmax_t largestHeader = std::uintmax_t(1) << 20;
  std::ifstream file(path, std::ios::binary);
  HeaderLines lines(file, largestHeader);
  TextHeader header;
  std::string line;
  while (header.fields.count("ElementDataFile") == 0 && lines.Read(line))
  {
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos)
    {
      const std::string name(Trim(line.substr(0, equals)));
      const std::string value(Trim(line.substr(equals + 1)));
      RefuseVolumeIf(header.fields.emplace(name, value).first->second != value,
                     path,
                     "its header has the field '" + name +
                       "' twice, with other values; export it again from its source");
    }
  }
  RefuseVolumeIf(header.Get("ElementDataFile").empty(),
                 path,
                 "its content is not MetaImage, as its name says; check where it came from");
  header.size = lines.GetSize();
  return header;
}

StoredType
TypeOf(const TextHeader & header, const fs::path & path)
{
  static const std::map<std::string, StoredType> types{
    { "MET_CHAR", std::int8_t() },         { "MET_UCHAR", std::uint8_t() },  { "MET_SHORT", std::int16_t() },
    { "MET_USHORT", std::uint16_t() },     { "MET_INT", std::int32_t() },    { "MET_UINT", std::uint32_t() },
    { "MET_LONG", std::int32_t() },        { "MET_ULONG", std::uint32_t() }, { "MET_LONG_LONG", std::int64_t() },
    { "MET_ULONG_LONG", std::uint64_t() }, { "MET_FLOAT", float() },         { "MET_DOUBLE", double() },
  };
  const std::string channels = header.Get("ElementNumberOfChannels");
  RefuseOtherIf(!channels.empty() && channels != "1",
                path,
                "its voxels are " + channels + " numbers each, not single numbers; extract one component first");
  const auto found = types.find(header.Get("ElementType"));
  RefuseVolumeIf(found == types.end(),
                 path,
                 "its pixel type '" + header.Get("ElementType") +
                   "' is not supported; convert it to integers or floats first");
  return found->second;
}

/** The \a count numbers of a field, or none without the field. */
std::vector<double>
PositionOf(const TextHeader & header, const std::vector<std::string> & keys, std::size_t count, const fs::path & path)
{
  const auto numbers = NumbersOf(header.Get(keys));
  if (!numbers || (!numbers->empty() && numbers->size() != count))
  {
    RefuseGeometry(path, "its header's " + keys.front() + " can't be read; export it again from its source");
  }
  return *numbers;
}

double
MillimetresPerUnit(const TextHeader & header, const fs::path & path)
{
  static const std::map<std::string, double> units{ { "", 1 }, { "?", 1 }, { "mm", 1 }, { "um", 1e-3 }, { "cm", 10 } };
  const auto found = units.find(header.Get("DistanceUnits"));
  RefuseGeometryIf(
    found == units.end(), path, "its DistanceUnits are " + header.Get("DistanceUnits") + "; write it in mm");
  return found->second;
}

/** Fills the geometry, matrix, isOriented and note. The rows of the matrix are the axes, as in ITK. */
void
Place(const TextHeader & header,
      const std::vector<std::uintmax_t> & sizes,
      const fs::path & path,
      StoredVolume & volume)
{
  const std::size_t dimension = sizes.size();
  const auto matrix = PositionOf(header, { "TransformMatrix", "Rotation", "Orientation" }, dimension * dimension, path);
  const auto offset = PositionOf(header, { "Offset", "Position", "Origin" }, dimension, path);
  const auto spacing = PositionOf(header, { "ElementSpacing" }, dimension, path);
  const double unit = MillimetresPerUnit(header, path);
  itk::Point<double, 3> origin;
  itk::Vector<double, 3> steps[3];
  for (unsigned int row = 0; row < 3; ++row)
  {
    origin[row] = offset.empty() ? 0.0 : offset[row] * unit;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double direction = matrix.empty() ? (row == axis ? 1.0 : 0.0) : matrix[axis * dimension + row];
      steps[axis][row] = direction * (spacing.empty() ? 1.0 : spacing[axis] * unit);
    }
  }
  volume.geometry = MakeGeometry({ { sizes[0], sizes[1], sizes[2] } }, origin, steps);
  volume.matrix = matrix.empty() ? "ElementSpacing" : "TransformMatrix";
  volume.isOriented = !matrix.empty();
  volume.note = spacing.empty()  ? "does not say how large its voxels are; 1 mm is a guess"
                : matrix.empty() ? "does not say how it lies in the patient; left and right are a guess"
                                 : "";
}

std::optional<ValueScaling>
ScalingOf(const TextHeader & header, const fs::path & path)
{
  const auto slope = NumbersOf(header.Get("ElementToIntensityFunctionSlope"));
  const auto offset = NumbersOf(header.Get("ElementToIntensityFunctionOffset"));
  ValueScaling scaling;
  scaling.slope = slope && slope->size() == 1 ? slope->front() : 1;
  scaling.intercept = offset && offset->size() == 1 ? offset->front() : 0;
  RefuseVolumeIf(!slope || !offset || !std::isfinite(scaling.slope) || !std::isfinite(scaling.intercept) ||
                   scaling.slope == 0,
                 path,
                 "its scaling of values (ElementToIntensityFunctionSlope, ElementToIntensityFunctionOffset) makes "
                 "no sense; export it again from its source");
  return scaling.slope == 1 && scaling.intercept == 0 ? std::nullopt : std::make_optional(scaling);
}

bool
IsBigEndian(const TextHeader & header, const fs::path & path)
{
  const bool hasBoth =
    header.fields.count("BinaryDataByteOrderMSB") > 0 && header.fields.count("ElementByteOrderMSB") > 0;
  const bool binaryData = IsTrue(header, "BinaryDataByteOrderMSB");
  const bool element = IsTrue(header, "ElementByteOrderMSB");
  RefuseVolumeIf(hasBoth && binaryData != element,
                 path,
                 "its header contradicts itself about the byte order; export it again from its source");
  return binaryData || element;
}

/** Finds the voxels, and checks that their file is long enough. */
void
FindVoxels(const TextHeader & header,
           const std::vector<std::uintmax_t> & sizes,
           const fs::path & path,
           StoredVolume & volume)
{
  const bool isDeflated = volume.encoding == "zlib";
  const std::string name = header.Get("ElementDataFile");
  const bool isLocal = LowerCase(name) == "local";
  const auto skip = SkipOf(header.Get("HeaderSize"), isDeflated);
  if (!skip)
  {
    RefuseVolume(path, "its header's HeaderSize makes no sense; export it again from its source");
  }
  volume.voxels.path = isLocal ? path : DetachedFile(path, name);
  volume.voxels.offset = *skip > 0 ? static_cast<std::uintmax_t>(*skip) : isLocal ? header.size : 0;
  volume.voxels.isDeflated = isDeflated;
  volume.voxels.isSwapped = IsBigEndian(header, path) != itk::ByteSwapper<int>::SystemIsBigEndian();
  RequireVoxels(sizes, *skip < 0, path, volume);
}

} // namespace

StoredVolume
ReadMetaImageVolume(const fs::path & path)
{
  const TextHeader header = ReadHeader(path);
  const std::vector<std::uintmax_t> sizes = AxisSizes(header.Get("NDims"), header.Get("DimSize"), path);
  StoredVolume volume;
  volume.type = TypeOf(header, path);
  volume.scaling = ScalingOf(header, path);
  RefuseOtherIf(!header.Get("BinaryData").empty() && !IsTrue(header, "BinaryData"),
                path,
                "its voxels are text, which is not supported; write it with BinaryData = True");
  volume.encoding = IsTrue(header, "CompressedData") ? "zlib" : "raw";
  volume.numberOfFrames = sizes.size() == 4 ? sizes[3] : 1;
  Place(header, sizes, path, volume);
  FindVoxels(header, sizes, path, volume);
  return volume;
}

} // namespace rhombic
