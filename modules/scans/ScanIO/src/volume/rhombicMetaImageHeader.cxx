#include "rhombicMetaImageHeader.h"

#include "rhombicTextHeader.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include "itkByteSwapper.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <map>
#include <sstream>
#include <string>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

struct MetaImageHeader
{
  std::map<std::string, std::string> fields;
  std::uintmax_t size = 0; ///< bytes up to the end of the line of ElementDataFile

  /** The value of the first of the keys that exists; empty when none does. */
  std::string
  Get(std::initializer_list<const char *> keys) const
  {
    for (const char * const key : keys)
    {
      if (const auto found = fields.find(key); found != fields.end())
      {
        return found->second;
      }
    }
    return "";
  }

  std::string
  Get(const char * key) const
  {
    return this->Get({ key });
  }

  bool
  IsTrue(const char * key) const
  {
    const std::string value = this->Get(key);
    return !value.empty() && (value.front() == 'T' || value.front() == 't' || value.front() == '1');
  }
};

MetaImageHeader
ReadHeader(const fs::path & path)
{
  constexpr std::size_t largestHeader = std::size_t(1) << 20;
  std::ifstream file(path, std::ios::binary);
  std::string beginning(largestHeader, '\0');
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<std::size_t>(file.gcount()));

  MetaImageHeader header;
  std::istringstream lines(beginning);
  std::string line;
  while (header.fields.count("ElementDataFile") == 0 && std::getline(lines, line))
  {
    header.size += line.size() + 1;
    const std::size_t equals = line.find('=');
    if (equals != std::string::npos)
    {
      header.fields[std::string(Trim(line.substr(0, equals)))] = Trim(line.substr(equals + 1));
    }
  }
  if (header.Get("ElementDataFile").empty())
  {
    RefuseVolume(path, "its content is not MetaImage, as its name says; check where it came from");
  }
  return header;
}

StoredType
TypeOf(const MetaImageHeader & header, const fs::path & path)
{
  static const std::map<std::string, StoredType> types{
    { "MET_CHAR", StoredType::Int8 },       { "MET_UCHAR", StoredType::UInt8 },
    { "MET_SHORT", StoredType::Int16 },     { "MET_USHORT", StoredType::UInt16 },
    { "MET_INT", StoredType::Int32 },       { "MET_UINT", StoredType::UInt32 },
    { "MET_LONG", StoredType::Int32 },      { "MET_ULONG", StoredType::UInt32 },
    { "MET_LONG_LONG", StoredType::Int64 }, { "MET_ULONG_LONG", StoredType::UInt64 },
    { "MET_FLOAT", StoredType::Float },     { "MET_DOUBLE", StoredType::Double },
  };
  const std::string channels = header.Get("ElementNumberOfChannels");
  if (!channels.empty() && channels != "1")
  {
    RefuseVolume(path, "its voxels are " + channels + " numbers each, not single numbers; extract one component first");
  }
  const auto found = types.find(header.Get("ElementType"));
  if (found == types.end())
  {
    RefuseVolume(path,
                 "its pixel type '" + header.Get("ElementType") +
                   "' is not supported; convert it to integers or floats first");
  }
  return found->second;
}

/** The \a count numbers of a field, or none without the field. */
std::vector<double>
PositionOf(const MetaImageHeader & header,
           std::initializer_list<const char *> keys,
           std::size_t count,
           const fs::path & path)
{
  const auto numbers = NumbersOf(header.Get(keys));
  if (!numbers || (!numbers->empty() && numbers->size() != count))
  {
    RefuseGeometry(path,
                   std::string("its header's ") + *keys.begin() + " can't be read; export it again from its source");
  }
  return *numbers;
}

double
MillimetresPerUnit(const MetaImageHeader & header, const fs::path & path)
{
  static const std::map<std::string, double> units{ { "", 1 }, { "?", 1 }, { "mm", 1 }, { "um", 1e-3 }, { "cm", 10 } };
  const auto found = units.find(header.Get("DistanceUnits"));
  if (found == units.end())
  {
    RefuseGeometry(path, "its DistanceUnits are " + header.Get("DistanceUnits") + "; write it in mm");
  }
  return found->second;
}

/** Fills the geometry, matrix, isOriented and note. The rows of the matrix are the axes, as in ITK. */
void
Place(const MetaImageHeader & header,
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
ScalingOf(const MetaImageHeader & header, const fs::path & path)
{
  const auto slope = NumbersOf(header.Get("ElementToIntensityFunctionSlope"));
  const auto offset = NumbersOf(header.Get("ElementToIntensityFunctionOffset"));
  ValueScaling scaling;
  scaling.slope = slope && slope->size() == 1 ? slope->front() : 1;
  scaling.intercept = offset && offset->size() == 1 ? offset->front() : 0;
  if (!slope || !offset || !std::isfinite(scaling.slope) || !std::isfinite(scaling.intercept) || scaling.slope == 0)
  {
    RefuseVolume(path,
                 "its scaling of values (ElementToIntensityFunctionSlope, ElementToIntensityFunctionOffset) makes "
                 "no sense; export it again from its source");
  }
  return scaling.slope == 1 && scaling.intercept == 0 ? std::nullopt : std::make_optional(scaling);
}

bool
IsBigEndian(const MetaImageHeader & header, const fs::path & path)
{
  const bool hasBoth =
    header.fields.count("BinaryDataByteOrderMSB") > 0 && header.fields.count("ElementByteOrderMSB") > 0;
  const bool binaryData = header.IsTrue("BinaryDataByteOrderMSB");
  const bool element = header.IsTrue("ElementByteOrderMSB");
  if (hasBoth && binaryData != element)
  {
    RefuseVolume(path, "its header contradicts itself about the byte order; export it again from its source");
  }
  return binaryData || element;
}

/** Finds the voxels, and checks that their file is long enough. */
void
FindVoxels(const MetaImageHeader & header,
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
  const MetaImageHeader header = ReadHeader(path);
  const std::vector<std::uintmax_t> sizes = AxisSizes(header.Get("NDims"), header.Get("DimSize"), path);
  StoredVolume volume;
  volume.type = TypeOf(header, path);
  volume.scaling = ScalingOf(header, path);
  if (!header.Get("BinaryData").empty() && !header.IsTrue("BinaryData"))
  {
    RefuseVolume(path, "its voxels are text, which is not supported; write it with BinaryData = True");
  }
  volume.encoding = header.IsTrue("CompressedData") ? "zlib" : "raw";
  volume.numberOfFrames = sizes.size() == 4 ? sizes[3] : 1;
  Place(header, sizes, path, volume);
  FindVoxels(header, sizes, path, volume);
  return volume;
}

} // namespace rhombic
