#include "rhombicFCCImageFile.h"

#include "rhombicAtomicFile.h"
#include "rhombicFailure.h"
#include "rhombicStoredVolume.h"
#include "rhombicTextHeader.h"
#include "rhombicVolumeRefusal.h"
#include "rhombicWording.h"

#include "detail/itkForEachLoadedPart.h"

#include <fstream>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

void
FailToWriteIf(bool isFailure, const fs::path & path, const std::string & why)
{
  FailIf(isFailure, FailureKind::Output, "Cannot write " + path.string() + ": " + why + ".");
}

/** The geometry of a lattice volume and the index of its first sample. */
struct Placement
{
  itk::Vector<double, 3> spacing;
  itk::Point<double, 3> origin;
  itk::Matrix<double, 3, 3> direction;
  itk::Index<3> start;
};

/** The defect of a placement as part of a sentence; empty when there is none. */
std::string
DefectOf(const Placement & placement)
{
  constexpr itk::IndexValueType farthest = itk::IndexValueType{ 1 } << 40; // no overflow of sums of indices and sizes
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
  FailToWriteIf(image == nullptr, path, "there is no image, but a null pointer; give an image that is filled");
  const auto & region = image->GetBufferedRegion();
  FailToWriteIf(region != image->GetLargestPossibleRegion() && image->GetSource() == nullptr,
                path,
                "not all samples of the image are in its buffer; update the whole of it first");
  FailToWriteIf(region.GetNumberOfPixels() == 0, path, "the image has no samples; give one of at least one sample");
  const auto * const pixels = image->GetPixelContainer();
  FailToWriteIf(pixels == nullptr || pixels->Size() < region.GetNumberOfPixels(),
                path,
                "the image's samples were never allocated; call its Allocate() and fill it first");
  const std::string defect =
    DefectOf({ image->GetSpacing(), image->GetOrigin(), image->GetDirection(), region.GetIndex() });
  FailToWriteIf(!defect.empty(), path, "the image's " + defect + "; set its geometry anew");
}

std::string
Join(std::initializer_list<double> numbers, const char * separator)
{
  std::string text;
  for (const double number : numbers)
  {
    text += (text.empty() ? "" : separator) + FormatExact(number);
  }
  return text;
}

/** The field "space directions" of the rows of parity 0: their steps along x are two lattice units long. */
template <typename TImage>
std::string
SpaceDirections(const TImage & image)
{
  const auto & direction = image.GetDirection();
  std::string text;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double step = (axis == 0 ? 2.0 : 1.0) * image.GetSpacing()[axis];
    text += " (" + Join({ direction[0][axis] * step, direction[1][axis] * step, direction[2][axis] * step }, ",") + ")";
  }
  return text;
}

template <typename TPixel>
std::string
MakeHeader(const itk::FCCImage<TPixel> & image)
{
  const auto & region = image.GetLargestPossibleRegion();
  const auto & start = region.GetIndex();
  const auto & size = region.GetSize();
  const auto & spacing = image.GetSpacing();
  const auto & origin = image.GetOrigin();
  const auto & d = image.GetDirection();
  const auto first = image.template TransformLatticeToPhysicalPoint<double>(
    { 2.0 * static_cast<double>(start[0]), static_cast<double>(start[1]), static_cast<double>(start[2]) });
  return "NRRD0005\n"
         "# Samples on the face-centered cubic lattice: index (i, j, k) is at lattice coordinates (2 i + p, j, k),\n"
         "# p = (j + k) mod 2; position = origin + direction * (spacing * coordinates), LPS mm. Indices begin at "
         "'start'.\n"
         "# The space fields are those of the rows with p = 0, for readers that know Cartesian grids only.\n"
         "type: " +
         PixelTypeName<TPixel>() +
         "\ndimension: 3"
         "\nspace: left-posterior-superior"
         "\nsizes: " +
         std::to_string(size[0]) + " " + std::to_string(size[1]) + " " + std::to_string(size[2]) +
         "\nspace directions:" + SpaceDirections(image) +
         "\nkinds: domain domain domain"
         "\nendian: little"
         "\nencoding: raw"
         "\nspace origin: (" +
         Join({ first[0], first[1], first[2] }, ",") + ")\n" + NRRDHeader::LatticeKey +
         ":=" + NRRDHeader::LatticeValue + "\nlattice spacing:=" + Join({ spacing[0], spacing[1], spacing[2] }, " ") +
         "\nlattice origin:=" + Join({ origin[0], origin[1], origin[2] }, " ") + "\nlattice direction:=" +
         Join({ d[0][0], d[0][1], d[0][2], d[1][0], d[1][1], d[1][2], d[2][0], d[2][1], d[2][2] }, " ") +
         "\nlattice start:=" + std::to_string(start[0]) + " " + std::to_string(start[1]) + " " +
         std::to_string(start[2]) + "\n\n";
}

template <typename TNumber>
std::vector<TNumber>
ToNumbers(const std::string & text, std::size_t count, const fs::path & path)
{
  std::vector<TNumber> numbers;
  for (const std::string_view word : SplitWords(text))
  {
    if (const auto number = ToNumber<TNumber>(word))
    {
      numbers.push_back(*number);
      continue;
    }
    numbers.clear();
    break;
  }
  RefuseVolumeIf(numbers.size() != count,
                 path,
                 "its header has '" + text + "' where " + std::to_string(count) + " numbers are expected");
  return numbers;
}

Placement
ReadPlacement(const NRRDHeader & header, const fs::path & path)
{
  const auto spacing = ToNumbers<double>(header.GetValue("lattice spacing"), 3, path);
  const auto origin = ToNumbers<double>(header.GetValue("lattice origin"), 3, path);
  const auto direction = ToNumbers<double>(header.GetValue("lattice direction"), 9, path);
  const auto start = ToNumbers<std::int64_t>(header.GetValue("lattice start"), 3, path);
  Placement placement;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    placement.spacing[axis] = spacing[axis];
    placement.origin[axis] = origin[axis];
    placement.start[axis] = start[axis];
    for (unsigned int column = 0; column < 3; ++column)
    {
      placement.direction[axis][column] = direction[3 * axis + column];
    }
  }
  const std::string defect = DefectOf(placement);
  RefuseVolumeIf(!defect.empty(), path, "its " + defect);
  return placement;
}

template <typename TPixel>
FCCVolume
ReadSamples(const NRRDHeader & header, const fs::path & path)
{
  const auto sizes = ToNumbers<std::uint64_t>(header.Get("sizes"), 3, path);
  const Placement placement = ReadPlacement(header, path);
  const std::uint64_t available = fs::file_size(path) - header.size;
  const std::uintmax_t needed = ProductOf({ sizes[0], sizes[1], sizes[2], sizeof(TPixel) }).value_or(0);
  RefuseVolumeIf(needed == 0 || needed > available,
                 path,
                 "its header promises more samples than the file holds; it may have been cut off, so copy it again");
  RefuseVolumeIf(needed < available, path, "it holds more data than its header says");

  auto image = itk::FCCImage<TPixel>::New();
  image->SetRegions(itk::ImageRegion<3>(placement.start, { { sizes[0], sizes[1], sizes[2] } }));
  image->SetSpacing(placement.spacing);
  image->SetOrigin(placement.origin);
  image->SetDirection(placement.direction);
  image->Allocate();
  std::ifstream stream(path, std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(header.size));
  stream.read(reinterpret_cast<char *>(image->GetBufferPointer()), static_cast<std::streamsize>(available));
  RefuseVolumeIf(!stream, path, "reading its samples failed");
  return image;
}

/** Reads the samples as the first of the pixel types that the header names. */
template <typename... TPixels>
FCCVolume
ReadSamplesOfAny(PixelTypeList<TPixels...>, const NRRDHeader & header, const fs::path & path)
{
  const std::string type = CanonicalNRRDType(header.Get("type"));
  FCCVolume volume;
  const bool isKnown =
    ((type == PixelTypeName<TPixels>() && (volume = ReadSamples<TPixels>(header, path), true)) || ...);
  RefuseVolumeIf(!isKnown,
                 path,
                 "its sample type '" + header.Get("type") + "' is not " + Enumerate({ PixelTypeName<TPixels>()... }));
  return volume;
}

} // namespace

void
StageFCCImage(const FCCVolume & volume, const fs::path & path, StagedFiles & staged)
{
  std::visit([&path](const auto & image) { VerifyImage(image.GetPointer(), path); }, volume);
  AtomicFile & file = staged.Begin(path);
  std::size_t size = 0;
  bool isWritten = false;
  std::visit(
    [&](const auto & image) {
      using PixelType = typename std::decay_t<decltype(*image)>::PixelType;
      const std::string header = MakeHeader(*image);
      const std::size_t bytes = image->GetLargestPossibleRegion().GetNumberOfPixels() * sizeof(PixelType);
      std::ofstream stream(file.GetTemporaryPath(), std::ios::binary | std::ios::trunc);
      stream << header;
      const std::size_t bytesOfPlane = bytes / image->GetLargestPossibleRegion().GetSize(2);
      itk::ForEachLoadedPart(*image, [&](std::size_t begin, std::size_t end) {
        itk::Index<3> start = image->GetLargestPossibleRegion().GetIndex();
        start[2] += static_cast<itk::IndexValueType>(begin);
        stream.write(reinterpret_cast<const char *>(image->GetBufferPointer() + image->ComputeOffset(start)),
                     static_cast<std::streamsize>((end - begin) * bytesOfPlane));
      });
      stream.close();
      isWritten = !stream.fail();
      size = header.size() + bytes;
    },
    volume);
  file.Flush(size);
  FailToWriteIf(!isWritten, path, "not all bytes arrived");
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
  FailIf(!fs::is_regular_file(path, error),
         FailureKind::NotFound,
         "There is no file " + path.string() + "; check the path.");
  RefuseVolumeIf(
    !IsFCCImageFile(path), path, "it is not a volume on the face-centered cubic lattice; give it as a scan instead");
  const NRRDHeader header = ReadNRRDHeader(path);
  RefuseVolumeIf(LowerCase(header.Get("encoding")) != "raw" || header.Get("dimension") != "3" ||
                   (LowerCase(header.Get("endian")) != "little" && CanonicalNRRDType(header.Get("type")) != "uint8"),
                 path,
                 "only raw, little-endian, three-dimensional lattice volumes are supported");
  return ReadSamplesOfAny(PixelTypes(), header, path);
}

bool
IsFCCImageFile(const fs::path & path)
{
  std::error_code error;
  if (!fs::is_regular_file(path, error)) // opening a pipe would wait for its writer
  {
    return false;
  }
  try
  {
    return ReadNRRDHeader(path).IsLattice();
  }
  catch (const Failure &) // it is no NRRD file
  {
    return false;
  }
}

} // namespace rhombic
