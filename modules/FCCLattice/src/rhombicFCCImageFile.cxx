#include "rhombicFCCImageFile.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicNRRDType.h"

#include <itksys/SystemTools.hxx>

#include <charconv>
#include <fstream>
#include <map>
#include <sstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr char latticeKey[] = "lattice:";
constexpr char latticeValue[] = "fcc parity rows";

[[noreturn]] void
FailToRead(const fs::path & path, const std::string & why)
{
  throw Failure(FailureKind::Unreadable, "Cannot read " + path.string() + ": " + why + ".");
}

[[noreturn]] void
FailToWrite(const fs::path & path, const std::string & why)
{
  throw Failure(FailureKind::Output, "Cannot write " + path.string() + ": " + why + ".");
}

/** Where the samples of an image are in the world. */
struct Placement
{
  itk::Vector<double, 3> spacing;
  itk::Point<double, 3> origin;
  itk::Matrix<double, 3, 3> direction;
  itk::Index<3> start;
};

/** What is wrong with a placement, as part of a sentence; empty when nothing is. */
std::string
DefectOf(const Placement & placement)
{
  constexpr itk::IndexValueType farthest = itk::IndexValueType{ 1 } << 40; // sums of indices and sizes stay countable
  constexpr double largest = 1e30; // products stay finite, or ITK would end the program
  bool isDirectionInRange = true;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (!(placement.spacing[axis] > 0.0 && placement.spacing[axis] < largest))
    {
      return "lattice spacing is not positive or out of range";
    }
    if (!(std::abs(placement.origin[axis]) < largest) || placement.start[axis] > farthest ||
        placement.start[axis] < -farthest)
    {
      return "lattice origin or start is out of range";
    }
    for (unsigned int column = 0; column < 3; ++column)
    {
      isDirectionInRange = isDirectionInRange && std::abs(placement.direction[axis][column]) < largest;
    }
  }
  const bool isSingular = std::abs(vnl_determinant(placement.direction.GetVnlMatrix())) <= 1e-6;
  return isDirectionInRange && !isSingular ? "" : "lattice direction is singular or out of range";
}

/** Throws Failure(Output) for an image that ReadFCCImage() would not read back. */
template <typename TImage>
void
VerifyImage(const TImage * image, const fs::path & path)
{
  if (image == nullptr)
  {
    FailToWrite(path, "there is no image, but a null pointer; give an image that is filled");
  }
  const auto & region = image->GetBufferedRegion();
  if (region != image->GetLargestPossibleRegion())
  {
    FailToWrite(path, "not all samples of the image are in its buffer; update the whole of it first");
  }
  if (region.GetNumberOfPixels() == 0)
  {
    FailToWrite(path, "the image has no samples; give one of at least one sample");
  }
  const auto * const pixels = image->GetPixelContainer();
  if (pixels == nullptr || pixels->Size() < region.GetNumberOfPixels())
  {
    FailToWrite(path, "the image's samples were never allocated; call its Allocate() and fill it first");
  }
  const std::string defect =
    DefectOf({ image->GetSpacing(), image->GetOrigin(), image->GetDirection(), region.GetIndex() });
  if (!defect.empty())
  {
    FailToWrite(path, "the image's " + defect + "; set its geometry anew");
  }
}

template <typename TPixel>
constexpr const char *
TypeName()
{
  if constexpr (std::is_same_v<TPixel, std::uint8_t>)
  {
    return "uint8";
  }
  else if constexpr (std::is_same_v<TPixel, std::int16_t>)
  {
    return "int16";
  }
  else if constexpr (std::is_same_v<TPixel, std::uint16_t>)
  {
    return "uint16";
  }
  else if constexpr (std::is_same_v<TPixel, std::int32_t>)
  {
    return "int32";
  }
  else
  {
    return "float";
  }
}

/** Shortest text that reads back as the same number, whatever the locale. */
std::string
ToText(double value)
{
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text), value).ptr;
  return std::string(text, end);
}

template <typename TNumber>
std::vector<TNumber>
ToNumbers(const std::string & text, std::size_t count, const fs::path & path)
{
  std::vector<TNumber> numbers;
  const char * next = text.data();
  const char * const end = next + text.size();
  while (numbers.size() < count)
  {
    while (next != end && *next == ' ')
    {
      ++next;
    }
    TNumber number{};
    const auto parsed = std::from_chars(next, end, number);
    if (parsed.ec != std::errc())
    {
      FailToRead(path, "its header has '" + text + "' where " + std::to_string(count) + " numbers are expected");
    }
    numbers.push_back(number);
    next = parsed.ptr;
  }
  if (next != end)
  {
    FailToRead(path, "its header has '" + text + "' where " + std::to_string(count) + " numbers are expected");
  }
  return numbers;
}

template <typename TPixel>
std::string
MakeHeader(const itk::FCCImage<TPixel> & image)
{
  const auto & region = image.GetBufferedRegion();
  const auto & direction = image.GetDirection();
  const auto & spacing = image.GetSpacing();
  const double step[3] = { 2.0 * spacing[0], spacing[1], spacing[2] };
  std::ostringstream header;
  header.imbue(std::locale::classic());
  header << "NRRD0005\n"
         << "# Samples on the face-centered cubic lattice: index (i, j, k) is at lattice coordinates (2 i + p, j, k),\n"
         << "# p = (j + k) mod 2; position = origin + direction * (spacing * coordinates), LPS mm. Indices begin at "
            "'start'.\n"
         << "# The space fields are those of the rows with p = 0, for readers that know Cartesian grids only.\n"
         << "type: " << TypeName<TPixel>() << "\ndimension: 3\nspace: left-posterior-superior\nsizes:";
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    header << ' ' << region.GetSize(axis);
  }
  header << "\nspace directions:";
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    header << " (" << ToText(direction[0][axis] * step[axis]) << ',' << ToText(direction[1][axis] * step[axis]) << ','
           << ToText(direction[2][axis] * step[axis]) << ')';
  }
  const auto first =
    image.template TransformLatticeToPhysicalPoint<double>({ 2.0 * static_cast<double>(region.GetIndex(0)),
                                                             static_cast<double>(region.GetIndex(1)),
                                                             static_cast<double>(region.GetIndex(2)) });
  header << "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: (" << ToText(first[0]) << ','
         << ToText(first[1]) << ',' << ToText(first[2]) << ")\n"
         << latticeKey << '=' << latticeValue << "\nlattice spacing:=";
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    header << (axis > 0 ? " " : "") << ToText(spacing[axis]);
  }
  header << "\nlattice origin:=";
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    header << (axis > 0 ? " " : "") << ToText(image.GetOrigin()[axis]);
  }
  header << "\nlattice direction:=";
  for (unsigned int n = 0; n < 9; ++n)
  {
    header << (n > 0 ? " " : "") << ToText(direction[n / 3][n % 3]);
  }
  header << "\nlattice start:=" << region.GetIndex(0) << ' ' << region.GetIndex(1) << ' ' << region.GetIndex(2)
         << "\n\n";
  return header.str();
}

using Fields = std::map<std::string, std::string>;

/** One line of a header. A file that is none could have a first line of gigabytes, so \a budget, in bytes, is all that
 * may be read. Returns false at the end of the file or of the budget. */
bool
ReadLine(std::istream & stream, std::size_t & budget, std::string & line)
{
  line.clear();
  for (char letter = 0; budget > 0 && stream.get(letter); --budget)
  {
    if (letter == '\n')
    {
      return true;
    }
    line += letter;
  }
  return false;
}

/** The header's fields ("name: value", names in lower case) and key/value pairs ("key:=value"), none when there is no
 * header; leaves the stream at the first sample. */
Fields
ReadHeader(std::istream & stream)
{
  std::size_t budget = 1 << 16;
  std::string line;
  Fields fields;
  if (!ReadLine(stream, budget, line) || line.compare(0, 4, "NRRD") != 0)
  {
    return {};
  }
  while (ReadLine(stream, budget, line))
  {
    if (line.empty())
    {
      return fields;
    }
    const auto pair = line.find(":=");
    const auto field = line.find(": ");
    if (line[0] == '#')
    {
      continue;
    }
    if (pair != std::string::npos)
    {
      fields[line.substr(0, pair) + ":"] = line.substr(pair + 2);
    }
    else if (field != std::string::npos)
    {
      fields[itksys::SystemTools::LowerCase(line.substr(0, field))] = line.substr(field + 2);
    }
  }
  return {};
}

template <typename TPixel>
FCCVolume
ReadSamples(std::istream & stream, Fields & fields, const fs::path & path)
{
  using ImageType = itk::FCCImage<TPixel>;
  const auto sizes = ToNumbers<std::uint64_t>(fields["sizes"], 3, path);
  const auto spacing = ToNumbers<double>(fields["lattice spacing:"], 3, path);
  const auto origin = ToNumbers<double>(fields["lattice origin:"], 3, path);
  const auto numbers = ToNumbers<double>(fields["lattice direction:"], 9, path);
  const auto start = ToNumbers<std::int64_t>(fields["lattice start:"], 3, path);

  const auto begin = static_cast<std::uint64_t>(stream.tellg());
  const auto available = static_cast<std::uint64_t>(fs::file_size(path)) - begin;
  std::uint64_t bytes = sizeof(TPixel);
  for (const std::uint64_t size : sizes)
  {
    if (size == 0 || bytes > available / size)
    {
      FailToRead(path,
                 "its header promises more samples than the file holds; it may have been cut off, so copy it again");
    }
    bytes *= size;
  }
  if (bytes != available)
  {
    FailToRead(path, "it holds more data than its header says");
  }

  typename ImageType::RegionType region;
  Placement placement;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    placement.spacing[axis] = spacing[axis];
    placement.origin[axis] = origin[axis];
    placement.start[axis] = start[axis];
    for (unsigned int column = 0; column < 3; ++column)
    {
      placement.direction[axis][column] = numbers[3 * axis + column];
    }
    region.SetSize(axis, sizes[axis]);
  }
  const std::string defect = DefectOf(placement);
  if (!defect.empty())
  {
    FailToRead(path, "its " + defect);
  }
  region.SetIndex(placement.start);
  auto image = ImageType::New();
  image->SetRegions(region);
  image->SetSpacing(placement.spacing);
  image->SetOrigin(placement.origin);
  image->SetDirection(placement.direction);
  image->Allocate();
  stream.read(reinterpret_cast<char *>(image->GetBufferPointer()), static_cast<std::streamsize>(bytes));
  if (!stream)
  {
    FailToRead(path, "reading its samples failed");
  }
  return image;
}

} // namespace

void
StageFCCImage(const FCCVolume & volume, const fs::path & path, StagedFiles & staged)
{
  std::visit([&path](const auto & image) { VerifyImage(image.GetPointer(), path); }, volume);
  AtomicFile & file = staged.Begin(path);
  std::size_t size = 0;
  std::visit(
    [&](const auto & image) {
      using PixelType = typename std::decay_t<decltype(*image)>::PixelType;
      const std::string header = MakeHeader(*image);
      const std::size_t bytes = image->GetBufferedRegion().GetNumberOfPixels() * sizeof(PixelType);
      std::ofstream stream(file.GetTemporaryPath(), std::ios::binary | std::ios::trunc);
      stream << header;
      stream.write(reinterpret_cast<const char *>(image->GetBufferPointer()), static_cast<std::streamsize>(bytes));
      stream.close();
      if (!stream)
      {
        throw Failure(FailureKind::Output, "Cannot write " + path.string() + ": writing failed; is the disk full?");
      }
      size = header.size() + bytes;
    },
    volume);
  file.Flush(size);
}

void
WriteFCCImage(const FCCVolume & volume, const fs::path & path)
{
  StagedFiles staged;
  StageFCCImage(volume, path, staged);
  staged.Commit();
}

FCCVolume
ReadFCCImage(const fs::path & path)
{
  std::error_code error;
  if (!fs::is_regular_file(path, error))
  {
    throw Failure(FailureKind::NotFound, "There is no file " + path.string() + "; check the path.");
  }
  std::ifstream stream(path, std::ios::binary);
  Fields fields = ReadHeader(stream);
  if (fields[latticeKey] != latticeValue)
  {
    FailToRead(path, "it is not a volume on the face-centered cubic lattice; give it as a scan instead");
  }
  const std::string type = CanonicalNRRDType(fields["type"]);
  if (itksys::SystemTools::LowerCase(fields["encoding"]) != "raw" || fields["dimension"] != "3" ||
      (itksys::SystemTools::LowerCase(fields["endian"]) != "little" && type != TypeName<std::uint8_t>()))
  {
    FailToRead(path, "only raw, little-endian, three-dimensional lattice volumes are supported");
  }
  if (type == TypeName<std::uint8_t>())
  {
    return ReadSamples<std::uint8_t>(stream, fields, path);
  }
  if (type == TypeName<std::int16_t>())
  {
    return ReadSamples<std::int16_t>(stream, fields, path);
  }
  if (type == TypeName<std::uint16_t>())
  {
    return ReadSamples<std::uint16_t>(stream, fields, path);
  }
  if (type == TypeName<std::int32_t>())
  {
    return ReadSamples<std::int32_t>(stream, fields, path);
  }
  if (type == TypeName<float>())
  {
    return ReadSamples<float>(stream, fields, path);
  }
  FailToRead(path, "its sample type '" + fields["type"] + "' is none of uint8, int16, uint16, int32, float");
}

bool
IsFCCImageFile(const fs::path & path)
{
  std::error_code error;
  if (!fs::is_regular_file(path, error)) // opening a pipe would wait for its writer
  {
    return false;
  }
  std::ifstream stream(path, std::ios::binary);
  const Fields fields = ReadHeader(stream);
  const auto lattice = fields.find(latticeKey);
  return lattice != fields.end() && lattice->second == latticeValue;
}

} // namespace rhombic
