#include "rhombicOMEZarrMetadata.h"

#include "rhombicWording.h"
#include "rhombicZarrArray.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

using Json = nlohmann::json;

/** A member of an object; null for others, and when there is none. */
const Json &
MemberOf(const Json & object, const char * name)
{
  static const Json null;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return object.is_object() && found != object.end() ? *found : null;
}

std::string
TextOf(const Json & value)
{
  return value.is_string() ? value.get<std::string>() : "";
}

[[noreturn]] void
RefusePlace(const fs::path & folder, const std::string & why)
{
  throw Failure(FailureKind::Geometry, "Cannot place " + folder.string() + " in the patient: " + why + ".");
}

/** The metadata of the image in a folder. Throws Failure when there is none, telling what there is. */
Json
ReadImageEntry(const fs::path & folder, bool followsLinks)
{
  std::error_code error;
  if (fs::exists(folder / "zarr.json", error))
  {
    RefuseZarr(folder, "it is Zarr version 3, and only version 2 (OME-Zarr 0.4) is read; write it in that version");
  }
  if (!fs::exists(folder / ".zattrs", error))
  {
    throw Failure(FailureKind::NotFound,
                  "Cannot read " + folder.string() +
                    ": it is a Zarr folder without the metadata of an image; name the folder of the image, which has "
                    "levels of a pyramid in it.");
  }
  const Json attributes = ReadZarrMetadata(folder, ".zattrs", followsLinks);
  const Json & images = MemberOf(attributes, "multiscales");
  if (images.is_array() && !images.empty())
  {
    return images;
  }
  const bool hasImages = attributes.contains("bioformats2raw.layout") || attributes.contains("plate") ||
                         attributes.contains("well") || attributes.contains("labels");
  throw Failure(
    FailureKind::NotFound,
    "Cannot read " + folder.string() + ": " +
      (hasImages ? "it holds several images, each in a folder of its own; name one, such as " + (folder / "0").string()
                 : "it is a Zarr folder without the metadata of an image (multiscales); name the folder of "
                   "the image") +
      ".");
}

/** Millimetres of a unit of length, by the names of OME-Zarr and the usual short ones; nothing for others. */
std::optional<double>
MillimetresOf(const std::string & unit)
{
  static const std::map<std::string, double> units{
    { "angstrom", 1e-7 }, { "picometer", 1e-9 },  { "nanometer", 1e-6 }, { "nm", 1e-6 },         { "micrometer", 1e-3 },
    { "micron", 1e-3 },   { "um", 1e-3 },         { "\u00b5m", 1e-3 },   { "\u03bcm", 1e-3 },    { "millimeter", 1.0 },
    { "mm", 1.0 },        { "centimeter", 10.0 }, { "cm", 10.0 },        { "decimeter", 100.0 }, { "meter", 1e3 },
    { "m", 1e3 },         { "inch", 25.4 },       { "foot", 304.8 }
  };
  const auto found = units.find(unit);
  return found == units.end() ? std::nullopt : std::make_optional(found->second);
}

bool
IsOfSpace(const Json & axis)
{
  const std::string type = TextOf(MemberOf(axis, "type"));
  const std::string name = TextOf(MemberOf(axis, "name"));
  return type.empty() ? name == "x" || name == "y" || name == "z" : type == "space";
}

/** The axes of space: their names and units. */
std::array<OMEZarrAxis, 3>
TakeAxes(const Json & axes, const fs::path & path)
{
  static const std::string names = "xyz";
  if (!axes.is_array() || axes.empty() || axes.size() > MostZarrAxes || !axes.front().is_object())
  {
    RefuseZarr(path, "it does not name one to five axes as OME-Zarr 0.4 does; write it in that version");
  }
  const auto count = static_cast<std::size_t>(std::count_if(axes.begin(), axes.end(), IsOfSpace));
  if (count < 3)
  {
    RefuseZarr(path, "it has " + Count(count, "axis", "axes") + " of space; it is no volume");
  }
  std::array<OMEZarrAxis, 3> result;
  std::array<bool, 3> isTaken{};
  for (std::size_t n = 0; n < 3; ++n)
  {
    const Json & axis = axes[axes.size() - 3 + n];
    const std::string name = LowerCase(TextOf(MemberOf(axis, "name")));
    const std::size_t dimension = name.size() == 1 ? names.find(name) : std::string::npos;
    if (count > 3 || !IsOfSpace(axis) || dimension == std::string::npos || isTaken[dimension])
    {
      RefuseZarr(path, "its last three axes are not x, y and z of space, in any order; write it so");
    }
    isTaken[dimension] = true;
    result[n].dimension = static_cast<unsigned int>(dimension);
    const Json & unit = MemberOf(axis, "unit");
    result[n].millimetresPerUnit = MillimetresOf(TextOf(unit));
    if (!unit.is_null() && !result[n].millimetresPerUnit)
    {
      RefusePlace(path, "the unit of its axis " + name + " is no known unit of length; write it in micrometer");
    }
  }
  return result;
}

/** Applies scales and translations, one after the other, to the steps and origins of the axes. */
void
Transform(const Json & transformations,
          std::size_t numberOfAxes,
          const fs::path & path,
          std::array<OMEZarrAxis, 3> & axes)
{
  if (transformations.is_null())
  {
    return;
  }
  for (const Json & transformation : transformations.is_array() ? transformations : Json::array({ 0 }))
  {
    const std::string type = TextOf(MemberOf(transformation, "type"));
    const Json & numbers = MemberOf(transformation, type == "scale" ? "scale" : "translation");
    const auto isNumber = [](const Json & number) { return number.is_number() && std::isfinite(number.get<double>()); };
    const bool isKnown = (type == "scale" || type == "translation") && numbers.is_array() &&
                         numbers.size() == numberOfAxes && std::all_of(numbers.begin(), numbers.end(), isNumber);
    if (!isKnown && type != "identity")
    {
      RefusePlace(path,
                  "its coordinateTransformations are not scales and translations with a number for each axis; write "
                  "them so");
    }
    for (std::size_t n = 0; n < 3 && isKnown; ++n)
    {
      const double number = numbers[numberOfAxes - 3 + n].get<double>();
      OMEZarrAxis & axis = axes[n];
      if (type == "scale")
      {
        axis.step = axis.step.value_or(1.0) * number;
        axis.origin *= number;
      }
      else
      {
        axis.origin += number;
      }
    }
  }
}

/** Throws Failure unless all steps are known, positive and in mm, or the options tell the size of voxels. */
void
TakeUnits(const OMEZarrOptions & options, const fs::path & path, OMEZarrMetadata & metadata)
{
  constexpr const char * names[] = { "x", "y", "z" };
  const auto isKnown = [](const OMEZarrAxis & axis) { return axis.step && axis.millimetresPerUnit; };
  if (options.voxelSize && std::all_of(metadata.axes.begin(), metadata.axes.end(), isKnown))
  {
    throw Failure(FailureKind::Usage,
                  "The size of the voxels of " + path.string() +
                    " can't be given, as its metadata tell it; leave out OMEZarrOptions::voxelSize.");
  }
  for (OMEZarrAxis & axis : metadata.axes)
  {
    const std::string name = names[axis.dimension];
    if (!isKnown(axis) && !options.voxelSize)
    {
      RefusePlace(path,
                  "it tells no " + std::string(axis.step ? "unit" : "scale") + " of its axis " + name +
                    ", and so no size of its voxels; give it with OMEZarrOptions::voxelSize");
    }
    constexpr double largest = 1e100; // whose square is a number, in any unit
    if (axis.step && !(*axis.step >= 1.0 / largest && *axis.step <= largest && std::abs(axis.origin) <= largest))
    {
      RefusePlace(path,
                  "the scale of its axis " + name +
                    " is not above 0, or scale or translation are beyond all numbers; "
                    "write them so");
    }
    if (options.voxelSize)
    {
      axis.millimetresPerUnit = (*options.voxelSize)[axis.dimension] / axis.step.value_or(1.0);
      axis.step = axis.step.value_or(1.0);
    }
  }
  if (options.voxelSize)
  {
    metadata.notes.emplace_back("does not tell how large its voxels are; the size that was given is used");
  }
}

} // namespace

OMEZarrMetadata
ReadOMEZarrMetadata(const fs::path & folder, const OMEZarrOptions & options)
{
  const Json images = ReadImageEntry(folder, options.followsLinks);
  const fs::path path = folder / ".zattrs";
  const Json & image = images.front();
  const Json version = MemberOf(image, "version");
  if (!version.is_null() && version != "0.4")
  {
    RefuseZarr(folder, "it is not OME-Zarr 0.4, but of version " + version.dump() + "; write it in version 0.4");
  }
  OMEZarrMetadata metadata;
  metadata.axes = TakeAxes(MemberOf(image, "axes"), path);
  metadata.numberOfAxes = MemberOf(image, "axes").size();
  const Json & levels = MemberOf(image, "datasets");
  metadata.numberOfLevels = levels.is_array() ? levels.size() : 0;
  if (metadata.numberOfLevels == 0)
  {
    RefuseZarr(path, "it names no levels (datasets); copy it again from its source");
  }
  if (options.level >= metadata.numberOfLevels)
  {
    throw Failure(FailureKind::Usage,
                  "Cannot read level " + std::to_string(options.level) + " of " + folder.string() + ": it has " +
                    Count(metadata.numberOfLevels, "level") +
                    ", counted from 0; choose another with OMEZarrOptions::level.");
  }
  const Json & level = levels[options.level];
  metadata.array = TextOf(MemberOf(level, "path"));
  const auto isOutside = [](const fs::path & part) { return part == ".." || part == "." || part.empty(); };
  if (metadata.array.empty() || metadata.array.is_absolute() ||
      std::any_of(metadata.array.begin(), metadata.array.end(), isOutside))
  {
    RefuseZarr(path, "the path of its level is no folder below this one; copy it again from its source");
  }
  Transform(MemberOf(level, "coordinateTransformations"), metadata.numberOfAxes, path, metadata.axes);
  Transform(MemberOf(image, "coordinateTransformations"), metadata.numberOfAxes, path, metadata.axes);
  TakeUnits(options, folder, metadata);
  metadata.notes.emplace_back("does not say how it lies in the patient; its axes x, y and z are taken for left, "
                              "posterior and superior, so that left and right are a guess");
  if (images.size() > 1)
  {
    metadata.notes.push_back("describes " + std::to_string(images.size()) + " images; the first one is read");
  }
  return metadata;
}

} // namespace rhombic
