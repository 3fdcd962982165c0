#include "rhombicNIfTIHeader.h"

#include "rhombicCompressedFile.h"
#include "rhombicFailure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

[[noreturn]] void
Refuse(const fs::path & path, const std::string & why)
{
  throw Failure(FailureKind::Unreadable, "Cannot read " + path.string() + ": " + why + ".");
}

/** The 348 bytes of a header, read in the byte order they were written in. */
class HeaderBytes
{
public:
  static constexpr std::size_t Size = 348;

  explicit HeaderBytes(const std::string & bytes)
    : m_Bytes(bytes)
  {
    m_Swap = this->Get<std::int32_t>(0) != static_cast<std::int32_t>(Size);
  }

  template <typename TValue>
  TValue
  Get(std::size_t offset) const
  {
    char value[sizeof(TValue)];
    std::memcpy(value, m_Bytes.data() + offset, sizeof(TValue));
    if (m_Swap)
    {
      std::reverse(value, value + sizeof(TValue));
    }
    TValue result;
    std::memcpy(&result, value, sizeof(TValue));
    return result;
  }

  std::string
  GetText(std::size_t offset, std::size_t size) const
  {
    return m_Bytes.substr(offset, size);
  }

private:
  std::string m_Bytes;
  bool m_Swap = false;
};

// Offsets of the fields that are needed.
constexpr std::size_t SizeField = 0;
constexpr std::size_t DimensionsField = 40;
constexpr std::size_t IntentField = 68;
constexpr std::size_t DatatypeField = 70;
constexpr std::size_t BitsField = 72;
constexpr std::size_t SpacingField = 76;
constexpr std::size_t PixelsOffsetField = 108;
constexpr std::size_t SlopeField = 112;
constexpr std::size_t InterceptField = 116;
constexpr std::size_t UnitsField = 123;
constexpr std::size_t QformCodeField = 252;
constexpr std::size_t SformCodeField = 254;
constexpr std::size_t QuaternionField = 256;
constexpr std::size_t QformOffsetField = 268;
constexpr std::size_t SformField = 280;
constexpr std::size_t MagicField = 344;

HeaderBytes
ReadHeader(const fs::path & path)
{
  const std::string bytes = ReadBeginning(path, HeaderBytes::Size);
  if (bytes.size() < HeaderBytes::Size)
  {
    Refuse(path, "its content is not NIfTI, as its name says; check where it came from");
  }
  const HeaderBytes header(bytes);
  std::string firstBytes = bytes.substr(0, 4);
  if (firstBytes == std::string("\x1c\x02\0\0", 4) || firstBytes == std::string("\0\0\x02\x1c", 4))
  {
    Refuse(path, "it is NIfTI-2, which is not supported; convert it to NIfTI-1");
  }
  if (header.Get<std::int32_t>(SizeField) != static_cast<std::int32_t>(HeaderBytes::Size))
  {
    Refuse(path, "its content is not NIfTI, as its name says; check where it came from");
  }
  return header;
}

/** The file that holds the pixels of \a path. */
fs::path
PixelsFile(const fs::path & path, const HeaderBytes & header)
{
  const std::string magic = header.GetText(MagicField, 4);
  const bool isPair = path.extension() == ".hdr";
  if (magic == std::string("n+1\0", 4) && !isPair)
  {
    return path;
  }
  if (magic != std::string("ni1\0", 4))
  {
    Refuse(path, "it is an Analyze file or a damaged NIfTI file, whose orientation is unknown; convert it to NIfTI");
  }
  for (const char * const extension : { ".img", ".img.gz" })
  {
    fs::path pixels = path;
    pixels.replace_extension(extension);
    if (isPair && fs::exists(pixels))
    {
      return pixels;
    }
  }
  Refuse(path, "its pixels should be in an .img file beside it, which is missing; put the two into one folder");
}

itk::Size<3>
ReadSize(const fs::path & path, const HeaderBytes & header)
{
  const auto dimension = [&header](int i) {
    return static_cast<int>(header.Get<std::int16_t>(DimensionsField + 2 * static_cast<std::size_t>(i)));
  };
  const int count = dimension(0);
  if (count < 3 || count > 7)
  {
    Refuse(path, "it has " + std::to_string(count) + " dimensions; a volume has three");
  }
  for (int i = 1; i <= count; ++i)
  {
    if (dimension(i) < 1)
    {
      Refuse(path, "its size along axis " + std::to_string(i) + " is " + std::to_string(dimension(i)));
    }
    if (i > 3 && dimension(i) > 1)
    {
      Refuse(path, "it holds " + std::to_string(dimension(i)) + " volumes or components; extract one of them first");
    }
  }
  return { { static_cast<itk::SizeValueType>(dimension(1)),
             static_cast<itk::SizeValueType>(dimension(2)),
             static_cast<itk::SizeValueType>(dimension(3)) } };
}

/** Bytes of a voxel; refuses those that are no single numbers. */
std::uintmax_t
ReadPixelSize(const fs::path & path, const HeaderBytes & header)
{
  struct Datatype
  {
    int code;
    int bits;
    const char * refusal; ///< nullptr for single numbers of a supported type
  };
  static constexpr std::array<Datatype, 17> datatypes{ {
    { 2, 8, nullptr },
    { 4, 16, nullptr },
    { 8, 32, nullptr },
    { 16, 32, nullptr },
    { 64, 64, nullptr },
    { 256, 8, nullptr },
    { 512, 16, nullptr },
    { 768, 32, nullptr },
    { 1024, 64, nullptr },
    { 1280, 64, nullptr },
    { 1, 1, "single bits" },
    { 32, 64, "complex numbers" },
    { 1792, 128, "complex numbers" },
    { 2048, 256, "complex numbers" },
    { 128, 24, "RGB colours" },
    { 2304, 32, "RGBA colours" },
    { 1536, 128, "128-bit numbers" },
  } };

  const int code = header.Get<std::int16_t>(DatatypeField);
  const auto * const found = std::find_if(
    datatypes.begin(), datatypes.end(), [code](const Datatype & datatype) { return datatype.code == code; });
  if (found == datatypes.end())
  {
    Refuse(path, "its pixel type " + std::to_string(code) + " is unknown");
  }
  if (found->refusal != nullptr)
  {
    Refuse(path, std::string("its pixels are ") + found->refusal + "; convert them to integers or floats first");
  }
  if (header.Get<std::int16_t>(BitsField) != found->bits)
  {
    Refuse(path, "its header contradicts itself about the bits of a pixel");
  }
  const int intent = header.Get<std::int16_t>(IntentField);
  if ((intent >= 1004 && intent <= 1010) || intent == 2003 || intent == 2004)
  {
    Refuse(path, "its pixels are vectors or matrices; extract one component first");
  }
  return static_cast<std::uintmax_t>(found->bits / 8);
}

/** Refuses scalings that ITK does not apply as NIfTI means them. A slope of 0 or NaN means that there is none. */
void
CheckScaling(const fs::path & path, const HeaderBytes & header)
{
  const float slope = header.Get<float>(SlopeField);
  const float intercept = header.Get<float>(InterceptField);
  const bool isScaled = slope != 0 && !std::isnan(slope);
  if (isScaled ? !std::isfinite(slope) || !std::isfinite(intercept) : slope == 0 && intercept != 0)
  {
    Refuse(path, "its scaling of values (scl_slope, scl_inter) makes no sense; export it again from its source");
  }
}

void
CheckPixels(const fs::path & path, const HeaderBytes & header, std::uintmax_t pixelsSize)
{
  const fs::path pixels = PixelsFile(path, header);
  const float offset = header.Get<float>(PixelsOffsetField);
  const float smallestOffset = pixels == path ? 352 : 0;
  if (!(offset >= smallestOffset && offset < 1e9f))
  {
    Refuse(path, "its header says that the pixels begin where they can't (vox_offset)");
  }
  const std::uintmax_t needed = static_cast<std::uintmax_t>(offset) + pixelsSize;
  const std::uintmax_t available = CountBytes(pixels, needed);
  if (available < needed)
  {
    Refuse(path,
           pixels.filename().string() + " has " + std::to_string(available) + " of " + std::to_string(needed) +
             " bytes; it is cut off or damaged, so copy it again");
  }
}

using Affine = std::array<itk::Vector<double, 3>, 4>; ///< the steps along three axes and the origin, in RAS

double
MillimetresPerUnit(const HeaderBytes & header)
{
  constexpr int metre = 1, micrometre = 3;
  const int unit = header.Get<std::uint8_t>(UnitsField) & 7;
  return unit == metre ? 1e3 : unit == micrometre ? 1e-3 : 1.0;
}

double
Spacing(const HeaderBytes & header, unsigned int axis)
{
  return header.Get<float>(SpacingField + 4 * (axis + 1));
}

Affine
Sform(const HeaderBytes & header)
{
  Affine affine;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int column = 0; column < 4; ++column)
    {
      affine[column][row] = header.Get<float>(SformField + 16 * row + 4 * column);
    }
  }
  return affine;
}

/** As nifti1.h defines it. */
Affine
Qform(const HeaderBytes & header)
{
  const double b = header.Get<float>(QuaternionField);
  const double c = header.Get<float>(QuaternionField + 4);
  const double d = header.Get<float>(QuaternionField + 8);
  const double a = std::sqrt(std::max(0.0, 1 - b * b - c * c - d * d));
  const double rotation[3][3] = {
    { a * a + b * b - c * c - d * d, 2 * b * c - 2 * a * d, 2 * b * d + 2 * a * c },
    { 2 * b * c + 2 * a * d, a * a + c * c - b * b - d * d, 2 * c * d - 2 * a * b },
    { 2 * b * d - 2 * a * c, 2 * c * d + 2 * a * b, a * a + d * d - c * c - b * b },
  };
  const double handedness = header.Get<float>(SpacingField) < 0 ? -1 : 1;
  Affine affine;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      affine[axis][row] = rotation[row][axis] * Spacing(header, axis) * (axis == 2 ? handedness : 1);
    }
    affine[3][row] = header.Get<float>(QformOffsetField + 4 * row);
  }
  return affine;
}

/** Along LPS axes: what ITK and most viewers do without any orientation. */
Affine
Unoriented(const HeaderBytes & header)
{
  Affine affine{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    affine[axis][axis] = Spacing(header, axis) * (axis == 2 ? 1 : -1);
  }
  return affine;
}

/** The largest distance between the places of a volume's corner by two affines. */
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
IsFinite(const Affine & affine)
{
  return std::all_of(
    affine.begin(), affine.end(), [](const auto & step) { return std::isfinite(step.GetSquaredNorm()); });
}

Affine
ChooseAffine(const fs::path & path, const HeaderBytes & header, const itk::Size<3> & size, Scan & scan)
{
  const bool hasSform = header.Get<std::int16_t>(SformCodeField) > 0;
  const bool hasQform = header.Get<std::int16_t>(QformCodeField) > 0;
  if (!hasSform && !hasQform)
  {
    scan.isOriented = false;
    scan.notes.push_back(path.string() + " does not say how it lies in the patient; left and right are a guess.");
    return Unoriented(header);
  }
  const Affine chosen = hasSform ? Sform(header) : Qform(header);
  if (hasSform && hasQform)
  {
    const double distance = CornerDistance(chosen, Qform(header), size);
    constexpr double tolerance = 1e-2; // of a voxel: the quaternion is rounded to float32
    if (distance > tolerance * chosen[0].GetNorm())
    {
      scan.notes.push_back(path.string() + " gives two positions in the patient, up to " +
                           std::to_string(distance * MillimetresPerUnit(header)) +
                           " mm apart; its sform was used, not its qform.");
    }
  }
  return chosen;
}

/** ITK reads all of these, whichever it uses, and aborts when one is not finite. */
void
CheckNumbers(const fs::path & path, const HeaderBytes & header)
{
  const bool hasSform = header.Get<std::int16_t>(SformCodeField) > 0;
  const bool hasQform = header.Get<std::int16_t>(QformCodeField) > 0;
  bool finite = IsFinite(Unoriented(header)) && std::isfinite(header.Get<float>(SpacingField));
  finite = finite && (!hasSform || IsFinite(Sform(header)));
  finite = finite && (!hasQform || IsFinite(Qform(header)));
  if (!finite)
  {
    throw Failure(FailureKind::Geometry,
                  "Cannot place " + path.string() +
                    " in the patient: its header holds numbers that are not finite; export it again from its source.");
  }
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (Spacing(header, axis) <= 0)
    {
      throw Failure(FailureKind::Geometry,
                    "Cannot place " + path.string() + " in the patient: its voxels have no size along axis " +
                      std::to_string(axis) + " (pixdim); export it again from its source.");
    }
  }
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

} // namespace

VolumeGeometry
ReadNIfTIGeometry(const fs::path & path, Scan & scan)
{
  fs::path headerPath = path;
  if (path.extension() == ".img" || (path.extension() == ".gz" && path.stem().extension() == ".img"))
  {
    headerPath = path.extension() == ".gz" ? path.parent_path() / path.stem() : path;
    headerPath.replace_extension(".hdr");
  }
  const HeaderBytes header = ReadHeader(headerPath);
  const itk::Size<3> size = ReadSize(headerPath, header);
  const std::uintmax_t pixelSize = ReadPixelSize(headerPath, header);
  CheckScaling(headerPath, header);
  CheckNumbers(headerPath, header);
  CheckPixels(headerPath, header, size[0] * size[1] * size[2] * pixelSize);

  return ToLPSMillimetres(ChooseAffine(headerPath, header, size, scan), MillimetresPerUnit(header), size);
}

} // namespace rhombic
