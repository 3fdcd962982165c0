#include "rhombicScanFormats.h"

#include "rhombicDicomHeader.h"
#include "rhombicFiles.h"
#include "rhombicFiniteValues.h"
#include "rhombicForEachBlock.h"
#include "rhombicMemoryBudget.h"
#include "rhombicSandbox.h"
#include "rhombicStoredVolume.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include "itkImageIOBase.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <map>
#include <memory>
#include <type_traits>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr char PictureHelper[] = "rhombic-unpack-picture";
constexpr std::size_t LargestBand = 8 << 20; // bytes of a picture that are unpacked at once

/** OpenImageIO's name of a picture's format; empty for other files. */
std::string
PictureFormatOf(const fs::path & path)
{
  static const std::map<std::string, std::string> formats{ { ".tif", "tiff" },     { ".tiff", "tiff" },
                                                           { ".png", "png" },      { ".jp2", "jpeg2000" },
                                                           { ".j2k", "jpeg2000" }, { ".bmp", "bmp" } };
  const auto found = formats.find(LowerCase(path.extension().string()));
  return found == formats.end() ? "" : found->second;
}

/** Whether a name comes before another one, where numbers in them count by their values: slice2 before slice10. */
bool
ComesBefore(const std::string & a, const std::string & b)
{
  const auto isDigit = [](char letter) { return letter >= '0' && letter <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size())
  {
    const auto numberAt = [&isDigit](const std::string & text, std::size_t & place) {
      const std::size_t first = std::min(text.find_first_not_of('0', place), text.size());
      place = first;
      while (place < text.size() && isDigit(text[place]))
      {
        ++place;
      }
      return text.substr(first, place - first);
    };
    if (isDigit(a[i]) && isDigit(b[j]))
    {
      const std::string one = numberAt(a, i), other = numberAt(b, j);
      if (one != other)
      {
        return one.size() != other.size() ? one.size() < other.size() : one < other;
      }
    }
    else if (a[i] != b[j])
    {
      return a[i] < b[j];
    }
    else
    {
      ++i;
      ++j;
    }
  }
  const bool aEnds = i == a.size(), bEnds = j == b.size();
  return aEnds != bEnds ? aEnds : a < b; // of names that differ by zeros only, the first in the alphabet
}

/** A picture's name with / for each number, as no name has it, without extension, and the numbers. */
std::pair<std::string, std::vector<std::uint64_t>>
SplitName(const fs::path & picture)
{
  std::pair<std::string, std::vector<std::uint64_t>> name;
  bool wasDigit = false;
  for (const char letter : picture.stem().string())
  {
    const bool isDigit = letter >= '0' && letter <= '9';
    if (!isDigit || !wasDigit)
    {
      name.first += isDigit ? '/' : letter;
    }
    if (isDigit && !wasDigit)
    {
      name.second.push_back(0);
    }
    if (isDigit)
    {
      name.second.back() = 10 * name.second.back() + static_cast<std::uint64_t>(letter - '0');
    }
    wasDigit = isDigit;
  }
  return name;
}

/** The places of slices, in steps from the first, by the numbers in their names: 0, 1, 3, ... Empty where names differ
 * by more than numbers, where no number rises by one step at most places and by multiples of it elsewhere, and of
 * decimals, dates and times. Throws Failure for pictures of the same numbers. */
std::vector<std::size_t>
FindPlaces(const std::vector<fs::path> & pictures)
{
  constexpr std::uint64_t largest = 100'000; // dates and most times are larger
  std::map<std::pair<std::string, std::vector<std::uint64_t>>, fs::path> names;
  std::vector<std::vector<std::uint64_t>> numbers;
  for (const fs::path & picture : pictures)
  {
    const auto [other, isNew] = names.emplace(SplitName(picture), picture);
    if (other->first.first.find("/./") != std::string::npos)
    {
      return {};
    }
    RefuseGeometryIf(!isNew,
                     picture,
                     "its name differs from " + other->second.filename().string() +
                       " by zeros or the extension only, and a slice of a stack has one picture; move one of them to "
                       "another folder");
    numbers.push_back(other->first.second);
  }
  std::vector<std::size_t> places;
  const bool areAlike = names.begin()->first.first == names.rbegin()->first.first; // and those between them
  for (std::size_t column = 0; areAlike && column < numbers.front().size(); ++column)
  {
    std::vector<std::uint64_t> steps;
    for (std::size_t n = 1; n < numbers.size(); ++n)
    {
      steps.push_back(numbers[n][column] - numbers[n - 1][column]);
    }
    const std::uint64_t step = *std::min_element(steps.begin(), steps.end());
    const auto isMultiple = [=](std::uint64_t one) { return one < largest && one % step == 0; };
    if (step > 0 && numbers.back()[column] < largest && std::all_of(steps.begin(), steps.end(), isMultiple) &&
        2 * std::count(steps.begin(), steps.end(), step) > static_cast<std::ptrdiff_t>(steps.size()) &&
        (places.empty() || places.back() > steps.size()))
    {
      places.assign(1, 0);
      for (const std::uint64_t one : steps)
      {
        places.push_back(places.back() + one / step);
      }
    }
  }
  return places;
}

/** FindPlaces() where slices are missing, and else nothing, with a note. Throws Failure unless gaps are accepted. */
std::vector<std::size_t>
AcceptGaps(const std::vector<fs::path> & pictures,
           const fs::path & folder,
           const ScanReadOptions & options,
           std::vector<std::string> & notes)
{
  const std::vector<std::size_t> places = FindPlaces(pictures);
  if (places.empty())
  {
    notes.push_back("Whether slices are missing can't be told by the names of the pictures, in which no number alone "
                    "changes, by one step.");
    return {};
  }
  const std::size_t missing = places.back() + 1 - places.size();
  if (missing == 0)
  {
    return {};
  }
  const std::string description = Count(missing, "slice is", "slices are") + " missing by the numbers in their names";
  const auto gap = std::adjacent_find(places.begin(), places.end(), [](auto a, auto b) { return b > a + 1; });
  const auto before = pictures.begin() + (gap - places.begin());
  FailIf(options.onGap == ScanReadOptions::Policy::Refuse,
         FailureKind::Geometry,
         "The pictures in " + folder.string() + " make no regular volume: " + description + ", the first between " +
           before[0].filename().string() + " and " + before[1].filename().string() +
           "; find the missing files, rename the others if none is missing, or take values across the gap with "
           "ScanReadOptions::onGap.");
  notes.push_back("Values are interpolated where pictures are missing: " + description + ".");
  return places;
}

/** What the header of a picture tells. */
struct PictureHeader
{
  std::size_t width = 0;
  std::size_t height = 0;
  int channels = 0;
  std::string type; ///< as "uint16"
  int bits = 0;     ///< of a value in the file; 0 if unknown

  std::size_t pages = 1;              ///< of the size of the first; this and all below of TIFF only
  std::size_t otherPages = 0;         ///< of other sizes
  std::size_t announced = 0;          ///< how many pages ImageJ has written, perhaps behind each other as one
  std::array<std::size_t, 3> sizes{}; ///< by OME-XML: slices, channels, times; 0 for unknown
  std::array<double, 3> voxel{};      ///< by OME-XML, in mm; 0 for unknown
};

SandboxJob
JobOf(const fs::path & picture, const std::string & what, std::size_t pieceSize)
{
  SandboxJob job{ PictureHelper, picture, PictureFormatOf(picture) + ' ' + what, pieceSize };
  job.limits.memory = std::uintmax_t{ 2 } << 30; // some decoders hold a whole picture, in wider numbers
  return job;
}

PictureHeader
ReadPictureHeader(const fs::path & path)
{
  constexpr std::size_t longest = 1024;
  SandboxRun run(JobOf(path, "header", longest));
  const auto piece = run.Next();
  RefuseVolumeIf(!piece, path, "it has no header of a picture; copy it again from its source");
  const auto * const text = reinterpret_cast<const char *>(piece->data);
  const auto json = nlohmann::json::parse(text, text + piece->size);
  run.Next();
  PictureHeader header{ json.at("width"), json.at("height"), json.at("channels"), json.at("type"), json.at("bits") };
  if (json.contains("pages"))
  {
    header.pages = json.at("pages");
    header.otherPages = json.at("others");
    header.announced = json.at("announced");
    header.sizes = json.at("sizes");
    header.voxel = json.at("voxel");
  }
  return header;
}

/** The type of a stack's values. Throws Failure for others, colours, and sizes that no volume has. */
StoredType
FindType(const PictureHeader & header, const fs::path & path)
{
  static const std::map<std::string, StoredType> types{ { "uint8", std::uint8_t() },   { "int8", std::int8_t() },
                                                        { "uint16", std::uint16_t() }, { "int16", std::int16_t() },
                                                        { "uint", std::uint32_t() },   { "uint32", std::uint32_t() },
                                                        { "int", std::int32_t() },     { "int32", std::int32_t() },
                                                        { "uint64", std::uint64_t() }, { "int64", std::int64_t() },
                                                        { "float", float() },          { "double", double() } };
  RefuseOtherIf(header.channels != 1,
                path,
                "its pixels have " + std::to_string(header.channels) +
                  " channels, as colours or transparency, and a slice of a stack has one value a pixel; convert the "
                  "pictures to grey");
  const auto found = types.find(header.type);
  RefuseOtherIf(found == types.end(), path, "its values are of type " + header.type + "; convert the pictures to grey");
  RefuseVolumeIf(header.width == 0 || header.height == 0, path, "it has no pixels; copy it again from its source");
  return found->second;
}

/** Throws Failure, naming both, for a picture that is not as the first of its stack. */
void
RequireSame(const PictureHeader & header,
            const fs::path & path,
            const PictureHeader & first,
            const fs::path & firstPath)
{
  const auto sizeOf = [](const PictureHeader & picture) {
    return std::to_string(picture.width) + " x " + std::to_string(picture.height);
  };
  const bool isSame = header.width == first.width && header.height == first.height && header.type == first.type &&
                      header.channels == first.channels && header.bits == first.bits;
  RefuseVolumeIf(!isSame,
                 path,
                 "it has " + sizeOf(header) + " pixels of " + Count(header.channels, "channel") + " in " + header.type +
                   ", and " + firstPath.filename().string() + " has " + sizeOf(first) + " of " +
                   Count(first.channels, "channel") + " in " + first.type +
                   "; a stack has slices of one kind, so move others to another folder");
}

/** Throws Failure for a picture of several pages, or of one that stands for several. */
void
RequireOnePage(const PictureHeader & header, const fs::path & path)
{
  RefuseVolumeIf(header.pages > 1,
                 path,
                 "it has " + Count(header.pages, "page") +
                   ", and a slice of a stack of pictures has one; name the file itself to read its pages as slices, or "
                   "move it to another folder");
}

/** Throws Failure for pages that are not the slices of one volume. */
void
RequireSlices(const PictureHeader & header, const fs::path & path)
{
  RefuseVolumeIf(header.announced > header.pages + header.otherPages,
                 path,
                 "ImageJ has written " + Count(header.announced, "picture") + " into it and a list of " +
                   Count(header.pages, "page") + ", as it does above 4 GB; save it as OME-TIFF, or as single pictures");
  RefuseVolumeIf(header.pages > 1 && header.otherPages > 0,
                 path,
                 Count(header.otherPages, "page") +
                   " of it have another size than the first, as the levels of a pyramid; save the slices alone");
  const auto [slices, channels, times] = header.sizes;
  RefuseOtherIf(header.pages > 1 && channels * times > 1,
                path,
                "its OME-XML tells of " + Count(channels, "channel") + " at " + Count(times, "time") +
                  ", and a volume has one of each; save one channel of one time");
  RefuseVolumeIf(header.pages > 1 && slices > header.pages,
                 path,
                 "its OME-XML tells of " + Count(slices, "slice") + ", and it has " + Count(header.pages, "page") +
                   "; put the files of all slices into one folder, or copy it again");
}

/** The voxel size that is given, or that OME-XML tells. Throws Failure(Usage) where there is none. */
std::array<double, 3>
FindVoxelSize(const PictureHeader & first, const fs::path & path, const ScanReadOptions & options, Scan & scan)
{
  const bool isTold = std::all_of(first.voxel.begin(), first.voxel.end(), [](double size) { return size > 0.0; });
  const bool isPartlyTold = !isTold && first.voxel != std::array<double, 3>{};
  FailIf(!isTold && !options.voxelSize,
         FailureKind::Usage,
         "Cannot read the pictures in " + path.string() + " as slices: they do not tell how large their voxels are" +
           (isPartlyTold ? " along each axis (PhysicalSizeX, Y and Z of OME-XML)" : "") +
           "; give their size with ScanReadOptions::voxelSize.");
  if (isTold && options.voxelSize && *options.voxelSize != first.voxel)
  {
    const auto describe = [](const std::array<double, 3> & size) {
      return DescribeSpacing(itk::Vector<double, 3>(size.data()));
    };
    scan.notes.push_back("The voxels of " + path.string() + " are taken for " + describe(*options.voxelSize) +
                         " as it is given, and not for " + describe(first.voxel) + " as OME-XML tells.");
  }
  return options.voxelSize.value_or(first.voxel);
}

/** \class PictureStack
 * \brief The values of pictures of one size and type, or of the pages of one picture, which are slices. */
class PictureStack
{
public:
  PictureStack(std::vector<fs::path> pictures, const PictureHeader & header, StoredType type)
    : m_Pictures(std::move(pictures))
    , m_Pages(header.pages)
    , m_Rows(header.height)
    , m_RowBytes(header.width * SizeOf(type))
  {}

  std::size_t
  GetDepth() const
  {
    return m_Pictures.size() * m_Pages;
  }

  std::size_t
  GetSliceBytes() const
  {
    return m_Rows * m_RowBytes;
  }

  /** Unpacks a slice. Throws Failure, naming the picture. */
  void
  Read(std::size_t slice, std::byte * values) const
  {
    const fs::path & path = m_Pictures[slice / m_Pages];
    const std::string page = std::to_string(slice % m_Pages);
    const std::string other =
      "its page " + page + " (from 0) is of another size or type than the first, or has changed";
    const std::size_t band = std::max(LargestBand, 512 * m_RowBytes); // with all rows of a tile
    SandboxRun run(JobOf(path, page, std::min(band, this->GetSliceBytes())));
    std::size_t done = 0;
    while (const auto piece = run.Next())
    {
      RefuseVolumeIf(piece->size > this->GetSliceBytes() - done, path, other);
      std::memcpy(values + done, piece->data, piece->size);
      done += piece->size;
    }
    RefuseVolumeIf(done != this->GetSliceBytes(), path, other);
  }

private:
  std::vector<fs::path> m_Pictures;
  std::size_t m_Pages; ///< of each
  std::size_t m_Rows;
  std::size_t m_RowBytes;
};

/** Reads all voxels, converted as OpenScan() documents. */
ScanImage
ReadStack(const PictureStack & stack,
          StoredType type,
          const VolumeGeometry & geometry,
          const TemporaryStore & store,
          const ProgressFunction & progress)
{
  const std::size_t sliceBytes = stack.GetSliceBytes();
  const auto read = [&](auto stored) -> ScanImage {
    using Stored = decltype(stored);
    if constexpr (std::is_constructible_v<ScanImage, typename itk::Image<Stored, 3>::Pointer>)
    {
      const auto image = NewImage<Stored>(geometry, store);
      auto * const values = reinterpret_cast<std::byte *>(image->GetBufferPointer());
      ForEachOnThreads(
        geometry.size[2], [&](std::size_t n) { stack.Read(n, values + n * sliceBytes); }, progress);
      return image;
    }
    else
    {
      std::vector<std::byte> slice(sliceBytes);
      std::size_t used = sliceBytes;
      std::size_t next = 0;
      const auto source = [&](std::byte * buffer, std::size_t size) {
        while (size > 0)
        {
          if (used == sliceBytes)
          {
            stack.Read(next++, slice.data());
            used = 0;
            if (progress)
            {
              progress(static_cast<double>(next) / static_cast<double>(geometry.size[2]));
            }
          }
          const std::size_t count = std::min(size, sliceBytes - used);
          std::memcpy(buffer, slice.data() + used, count);
          used += count;
          buffer += count;
          size -= count;
        }
      };
      return ReadVolumePixels(type, std::nullopt, geometry, source, store);
    }
  };
  return std::visit(read, type);
}

/** The voxels of a stack (see UnreadScan::native). */
NativeVoxels
NativeVoxelsOfStack(const PictureStack & stack, StoredType type, const VolumeGeometry & geometry)
{
  const auto read = [=](const itk::ImageRegion<3> & region, void * buffer) {
    std::vector<std::byte> slice(stack.GetSliceBytes());
    auto * values = static_cast<std::byte *>(buffer);
    const std::size_t rowBytes = region.GetSize(0) * SizeOf(type);
    for (std::size_t n = 0; n < region.GetSize(2); ++n)
    {
      stack.Read(static_cast<std::size_t>(region.GetIndex(2)) + n, slice.data());
      for (std::size_t row = 0; row < region.GetSize(1); ++row, values += rowBytes)
      {
        const std::size_t first = (static_cast<std::size_t>(region.GetIndex(1)) + row) * geometry.size[0];
        const std::size_t offset = (first + static_cast<std::size_t>(region.GetIndex(0))) * SizeOf(type);
        std::memcpy(values, slice.data() + offset, rowBytes);
      }
    }
  };
  const auto typeOf = [](auto stored) { return itk::ImageIOBase::MapPixelType<decltype(stored)>::CType; };
  return { std::visit(typeOf, type), true, read };
}

} // namespace

bool
IsPicture(const fs::path & path)
{
  return !PictureFormatOf(path).empty();
}

std::vector<fs::path>
FindPictures(const fs::path & folder, bool followsLinks)
{
  std::vector<fs::path> pictures;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
  {
    std::error_code entryError;
    const fs::path & path = entry->path();
    if (IsPicture(path) && path.filename().string()[0] != '.' && (followsLinks || !entry->is_symlink(entryError)) &&
        entry->is_regular_file(entryError))
    {
      pictures.push_back(path);
    }
  }
  if (pictures.empty())
  {
    return {};
  }
  const auto others = ListFiles(folder, followsLinks).paths;
  const bool hasDicom = std::any_of(others.begin(), others.end(), [](const fs::path & path) {
    return !IsPicture(path) && IsReadable(path) && ReadDicomHeader(path).has_value();
  });
  std::sort(pictures.begin(), pictures.end(), [](const fs::path & a, const fs::path & b) {
    return ComesBefore(a.filename().string(), b.filename().string());
  });
  return hasDicom ? std::vector<fs::path>() : pictures;
}

UnreadScan
OpenPictureStack(const std::vector<fs::path> & pictures, const fs::path & path, const ScanReadOptions & options)
{
  FailIf(options.frame.has_value(),
         FailureKind::Usage,
         "Cannot read a volume of several in " + path.string() +
           ": pictures are the slices of one; leave out ScanReadOptions::frame.");
  std::vector<PictureHeader> headers(pictures.size());
  ForEachOnThreads(pictures.size(), [&](std::size_t n) { headers[n] = ReadPictureHeader(pictures[n]); });
  const PictureHeader & first = headers.front();
  const StoredType type = FindType(first, pictures.front());
  for (std::size_t n = 0; n < pictures.size() && pictures.size() > 1; ++n)
  {
    RequireSame(headers[n], pictures[n], first, pictures.front());
    RequireOnePage(headers[n], pictures[n]);
  }
  RefuseVolumeIf(path == pictures.front() && first.pages == 1 && first.announced < 2,
                 path,
                 "it is a single picture, which is no volume; give the folder of all slices");
  RequireSlices(first, pictures.front());
  const PictureStack stack(pictures, first, type);
  UnreadScan file;
  Scan & scan = file.scan;
  std::array<double, 3> voxelSize = FindVoxelSize(first, path, options, scan);
  const auto places =
    pictures.size() > 1 ? AcceptGaps(pictures, path, options, scan.notes) : std::vector<std::size_t>();
  for (const std::size_t place : places)
  {
    scan.sliceOrigins.emplace_back(std::array<double, 3>{ 0.0, 0.0, static_cast<double>(place) * voxelSize[2] });
  }
  if (!places.empty())
  {
    voxelSize[2] *= static_cast<double>(places.back()) / static_cast<double>(places.size() - 1);
  }
  const VolumeGeometry geometry = MakeUnplacedGeometry({ { first.width, first.height, stack.GetDepth() } }, voxelSize);
  CheckGeometry(geometry, path, "voxel size", options.onTilted, scan.notes);
  scan.format = "pictures";
  scan.encoding = PictureFormatOf(pictures.front());
  scan.isOriented = false;
  scan.files = pictures;
  scan.image = NewVolumeImage(type, false, geometry);
  scan.notes.push_back(path.string() + " holds " +
                       (first.pages > 1 ? Count(first.pages, "page") + ", which are taken for slices"
                                        : Count(pictures.size(), "picture") +
                                            ", which are taken for slices in the order of the numbers in their names") +
                       ", with axes to the left, posterior and superior, so that left and right are a guess.");
  if (const auto bits = static_cast<std::size_t>(first.bits); bits > 0 && bits != 8 * SizeOf(type))
  {
    scan.notes.push_back("The pictures hold values of " + std::to_string(first.bits) + " bits, which are read as " +
                         std::to_string(8 * SizeOf(type)) + " bits, scaled to their range.");
  }
  file.findPlace = [=] {
    const std::uintmax_t bytes = MemoryOfPixels(type, false, geometry.GetNumberOfVoxels());
    return FindPlaceToRead(VoxelStore(path, options.temporaryFolder), bytes, 0, options.maximumMemory);
  };
  file.readVoxels = [=, findPlace = file.findPlace](Scan & read) {
    const bool isLarge = findPlace() == VoxelPlace::TemporaryFile;
    const TemporaryStore store = isLarge ? VoxelStore(path, options.temporaryFolder) : TemporaryStore();
    read.image = ReadStack(stack, type, geometry, store, options.progress);
    ReplaceNotFinite(path, read);
  };
  file.native = NativeVoxelsOfStack(stack, type, geometry);
  return file;
}

} // namespace rhombic
