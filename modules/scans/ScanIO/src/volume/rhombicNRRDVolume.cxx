#include "rhombicStoredVolume.h"

#include "rhombicTextHeader.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include "itkByteSwapper.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>
#include <map>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

StoredType
TypeOf(const NRRDHeader & header, const fs::path & path)
{
  static const std::map<std::string, StoredType> types{ { "int8", std::int8_t() },   { "uint8", std::uint8_t() },
                                                        { "int16", std::int16_t() }, { "uint16", std::uint16_t() },
                                                        { "int32", std::int32_t() }, { "uint32", std::uint32_t() },
                                                        { "int64", std::int64_t() }, { "uint64", std::uint64_t() },
                                                        { "float", float() },        { "double", double() } };
  const std::string name = header.Get("type");
  const auto found = types.find(CanonicalNRRDType(name));
  RefuseVolumeIf(found == types.end(),
                 path,
                 "its pixel type '" + name + "' is not supported; convert it to integers or floats first");
  return found->second;
}

/** The directions of the axes: an empty vector for "none", and no vectors without the field. */
std::vector<std::vector<double>>
DirectionsOf(const NRRDHeader & header, std::size_t dimension, const fs::path & path)
{
  const std::string text = header.Get("spacedirections");
  std::vector<std::vector<double>> directions;
  std::size_t position = 0;
  while ((position = text.find_first_not_of(" \t", position)) != std::string::npos)
  {
    std::size_t end = text.find(')', position);
    if (LowerCase(text.substr(position, 4)) == "none")
    {
      directions.emplace_back();
      end = position + 3;
    }
    else if (const auto numbers = NumbersOf(text.substr(position, end - position + 1));
             text[position] == '(' && end != std::string::npos && numbers && numbers->size() >= 3)
    {
      directions.push_back(*numbers);
    }
    else
    {
      RefuseGeometry(path, "its header's 'space directions' can't be read; export it again from its source");
    }
    position = end + 1;
  }
  RefuseGeometryIf(!directions.empty() && directions.size() != dimension,
                   path,
                   "its header has a wrong number of 'space directions'; export it again from its source");
  return directions;
}

/** The kinds of the axes in lower case; "domain" for unknown ones. */
std::vector<std::string>
KindsOf(const NRRDHeader & header, std::size_t dimension, const fs::path & path)
{
  const std::string text = LowerCase(header.Get("kinds"));
  const auto words = SplitWords(text);
  std::vector<std::string> kinds(words.begin(), words.end());
  RefuseVolumeIf(!kinds.empty() && kinds.size() != dimension,
                 path,
                 "its header has a wrong number of 'kinds'; export it again from its source");
  kinds.resize(dimension, "domain");
  std::replace_if(
    kinds.begin(), kinds.end(), [](const std::string & kind) { return kind == "???" || kind == "none"; }, "domain");
  return kinds;
}

bool
IsSpatial(const std::string & kind)
{
  return kind == "domain" || kind == "space";
}

/** The axis that counts the volumes; 3 when there is none. */
std::size_t
FrameAxis(const std::vector<std::string> & kinds,
          const std::vector<std::vector<double>> & directions,
          const fs::path & path)
{
  const std::size_t dimension = kinds.size();
  std::vector<std::size_t> candidates;
  for (std::size_t axis = 0; axis < dimension; ++axis)
  {
    const bool hasNoDirection = !directions.empty() && directions[axis].empty();
    if (hasNoDirection || !IsSpatial(kinds[axis]))
    {
      candidates.push_back(axis);
    }
  }
  for (const std::size_t axis : candidates)
  {
    if (!IsSpatial(kinds[axis]) && kinds[axis] != "list" && kinds[axis] != "time")
    {
      RefuseOther(path,
                  "its voxels are no single numbers (an axis is of the kind " + kinds[axis] +
                    "); extract one component first");
    }
  }
  RefuseOtherIf(candidates.size() > dimension - 3,
                path,
                "only " + std::to_string(dimension - candidates.size()) + " of its axes lie in space; it is no volume");
  const std::size_t frameAxis = candidates.empty() ? 3 : candidates.front();
  RefuseOtherIf(frameAxis == 1 || frameAxis == 2,
                path,
                "the axis of its volumes lies between the others, which is not supported; permute it first");
  if (!directions.empty() && frameAxis < dimension && directions[frameAxis].empty() && kinds[frameAxis] != "list")
  {
    RefuseOther(path,
                "the axis of its volumes is of the kind " + kinds[frameAxis] +
                  ", which is not supported; call it a list, or extract one volume first");
  }
  return frameAxis;
}

/** The signs along x and y from RAS, LAS or LPS to LPS; nothing for spaces without left and right. */
std::optional<std::array<double, 2>>
SignsToLPS(const std::string & space)
{
  static const std::map<std::string, std::array<double, 2>> signs{
    { "right-anterior-superior", { -1, -1 } },      { "ras", { -1, -1 } },
    { "left-anterior-superior", { 1, -1 } },        { "las", { 1, -1 } },
    { "left-posterior-superior", { 1, 1 } },        { "lps", { 1, 1 } },
    { "right-anterior-superior-time", { -1, -1 } }, { "rast", { -1, -1 } },
    { "left-anterior-superior-time", { 1, -1 } },   { "last", { 1, -1 } },
    { "left-posterior-superior-time", { 1, 1 } },   { "lpst", { 1, 1 } },
  };
  const auto found = signs.find(LowerCase(space));
  return found == signs.end() ? std::nullopt : std::make_optional(found->second);
}

double
MillimetresPerUnit(const NRRDHeader & header, const fs::path & path)
{
  static const std::map<std::string, double> units{ { "", 1 },           { "???", 1 },        { "mm", 1 },
                                                    { "millimeter", 1 }, { "um", 1e-3 },      { "\u00b5m", 1e-3 },
                                                    { "micron", 1e-3 },  { "microns", 1e-3 }, { "cm", 10 },
                                                    { "m", 1e3 },        { "meter", 1e3 } };
  std::string text = header.Get("spaceunits");
  std::replace(text.begin(), text.end(), '"', ' ');
  const std::string lower = LowerCase(text);
  const std::vector<std::string_view> words = SplitWords(lower);
  const std::string unit(words.empty() ? "" : words.front());
  const bool areSame = words.size() < 3 || (words[1] == unit && words[2] == unit);
  const auto found = units.find(unit);
  RefuseGeometryIf(
    found == units.end() || !areSame, path, "its 'space units' are " + std::string(Trim(text)) + "; write it in mm");
  return found->second;
}

/** Fills the geometry, matrix, isOriented and note. */
void
Place(const NRRDHeader & header,
      const std::vector<std::uintmax_t> & sizes,
      const std::vector<std::vector<double>> & directions,
      std::size_t frameAxis,
      const fs::path & path,
      StoredVolume & volume)
{
  const std::size_t firstAxis = frameAxis == 0 ? 1 : 0;
  const itk::Size<3> size{ { sizes[firstAxis], sizes[firstAxis + 1], sizes[firstAxis + 2] } };
  const double unit = MillimetresPerUnit(header, path);
  itk::Point<double, 3> origin;
  origin.Fill(0);
  itk::Vector<double, 3> steps[3];
  const auto spaceOrigin = NumbersOf(header.Get("spaceorigin"));
  RefuseGeometryIf(!spaceOrigin || (!spaceOrigin->empty() && spaceOrigin->size() < 3),
                   path,
                   "its header's 'space origin' can't be read; export it again from its source");
  if (directions.empty())
  {
    const auto spacings = NumbersOf(header.Get("spacings"));
    RefuseGeometryIf(!spacings || (!spacings->empty() && spacings->size() != sizes.size()),
                     path,
                     "its header's 'spacings' can't be read; export it again from its source");
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      steps[axis].Fill(0);
      steps[axis][axis] = spacings->empty() ? 1 : (*spacings)[firstAxis + axis] * unit;
      RefuseGeometryIf(
        steps[axis][axis] < 0, path, "its header's 'spacings' are negative; export it again from its source");
    }
    volume.geometry = MakeGeometry(size, origin, steps);
    volume.matrix = "spacings";
    volume.isOriented = false;
    volume.note = spacings->empty() ? "says neither how it lies in the patient nor how large its voxels are; left and "
                                      "right are a guess, and 1 mm is"
                                    : "does not say how it lies in the patient; left and right are a guess";
    return;
  }

  const auto signs = SignsToLPS(header.Get("space"));
  const auto coordinate = [&](const std::vector<double> & vector, unsigned int row) {
    return vector[row] * unit * (signs && row < 2 ? (*signs)[row] : 1.0);
  };
  for (unsigned int row = 0; row < 3; ++row)
  {
    origin[row] = spaceOrigin->empty() ? 0.0 : coordinate(*spaceOrigin, row);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      steps[axis][row] = coordinate(directions[firstAxis + axis], row);
    }
  }
  volume.geometry = MakeGeometry(size, origin, steps);
  volume.matrix = "'space directions'";
  volume.isOriented = signs.has_value();
  volume.note = !signs                 ? "does not say how it lies in the patient; left and right are a guess"
                : spaceOrigin->empty() ? "does not say where it begins; its first voxel was put at 0"
                                       : "";
}

std::string
EncodingOf(const NRRDHeader & header, const fs::path & path)
{
  const std::string name = LowerCase(header.Get("encoding"));
  RefuseOtherIf(name != "raw" && name != "gz" && name != "gzip",
                path,
                "its encoding '" + name + "' is not supported; write it as raw or gzip");
  return name == "raw" ? name : "gzip";
}

/** The position in \a data after \a count lines from \a begin. */
std::uintmax_t
PassLines(const fs::path & data, std::uintmax_t begin, std::uintmax_t count)
{
  std::ifstream file(data, std::ios::binary);
  file.seekg(static_cast<std::streamoff>(begin));
  for (; count > 0 && file; --count)
  {
    file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return file ? static_cast<std::uintmax_t>(file.tellg()) : fs::file_size(data);
}

/** Finds the voxels, and checks that their file is long enough. */
void
FindVoxels(const NRRDHeader & header,
           const std::vector<std::uintmax_t> & sizes,
           const fs::path & path,
           StoredVolume & volume)
{
  const bool isDeflated = volume.encoding == "gzip";
  const std::string name = header.Get("datafile");
  const fs::path file = name.empty() ? path : DetachedFile(path, name);
  const std::string endian = LowerCase(header.Get("endian"));
  RefuseVolumeIf(SizeOf(volume.type) > 1 && endian != "little" && endian != "big",
                 path,
                 "its header does not say in which byte order its voxels are; export it again from its source");
  const auto lineSkip = CountsOf(header.Get("lineskip"));
  const auto byteSkip = SkipOf(header.Get("byteskip"), isDeflated);
  RefuseVolumeIf(!lineSkip || lineSkip->size() > 1 || !byteSkip,
                 path,
                 "its header's 'line skip' or 'byte skip' makes no sense; export it again from its source");
  volume.voxels.path = file;
  volume.voxels.isDeflated = isDeflated;
  volume.voxels.isSwapped = (endian == "big") == itk::ByteSwapper<int>::SystemIsLittleEndian();
  volume.voxels.offset = PassLines(file, name.empty() ? header.size : 0, lineSkip->empty() ? 0 : lineSkip->front());
  volume.voxels.skip = static_cast<std::uintmax_t>(std::max(0.0, *byteSkip));
  RequireVoxels(sizes, *byteSkip < 0, path, volume);
}

} // namespace

StoredVolume
ReadNRRDVolume(const fs::path & path)
{
  const NRRDHeader header = ReadNRRDHeader(path);
  RefuseVolumeIf(header.IsLattice(),
                 path,
                 "it is a volume on the face-centered cubic lattice, not a scan of voxels; give the scan it was made "
                 "from");
  const std::vector<std::uintmax_t> sizes = AxisSizes(header.Get("dimension"), header.Get("sizes"), path);
  const auto directions = DirectionsOf(header, sizes.size(), path);
  const auto kinds = KindsOf(header, sizes.size(), path);
  const std::size_t frameAxis = FrameAxis(kinds, directions, path);

  StoredVolume volume;
  volume.type = TypeOf(header, path);
  volume.encoding = EncodingOf(header, path);
  if (frameAxis < sizes.size())
  {
    volume.numberOfFrames = sizes[frameAxis];
    volume.areFramesInterleaved = frameAxis == 0;
  }
  Place(header, sizes, directions, frameAxis, path, volume);
  FindVoxels(header, sizes, path, volume);
  return volume;
}

} // namespace rhombic
