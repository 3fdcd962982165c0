#ifndef itkFilterDescription_h
#define itkFilterDescription_h

#include "itkFCCImage.h"
#include "itkImage.h"
#include "itkImageAlgorithm.h"
#include "itkTriangleSurfaceToTriangleSurfaceFilter.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <random>
#include <string>
#include <vector>

/** What the conformance tests must know about a filter, and how they make its inputs and read its outputs. */
namespace filtertest
{

using RegionType = itk::ImageRegion<3>;
using SizeType = itk::Size<3>;
using Random = std::mt19937;

inline double
Uniform(Random & random, double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(random);
}

/** From \a low to \a high, both included. */
inline long
Integer(Random & random, long low, long high)
{
  return std::uniform_int_distribution<long>(low, high)(random);
}

/** A parameter of a filter: its values by default and another good one, and those that the filter must refuse. */
template <typename TFilter>
struct Parameter
{
  struct Refusal
  {
    std::function<void(TFilter &)> set;
    std::string remedy; ///< what the exception must say
  };

  std::string name; ///< as it is printed
  std::function<void(TFilter &)> setDefault;
  std::function<void(TFilter &)> setOther;
  std::function<bool(const TFilter &)> isDefault;
  std::function<bool(const TFilter &)> isOther;
  std::vector<Refusal> refusals;
};

template <typename TFilter, typename TArgument, typename TReturn, typename TValue = std::decay_t<TReturn>>
Parameter<TFilter>
MakeParameter(const std::string & name,
              void (TFilter::*set)(TArgument),
              TReturn (TFilter::*get)() const,
              const std::decay_t<TReturn> & initial,
              const std::decay_t<TReturn> & other,
              const std::vector<std::decay_t<TReturn>> & refused = {},
              const std::string & remedy = {})
{
  const auto setTo = [set](const TValue & value) { return [set, value](TFilter & filter) { (filter.*set)(value); }; };
  const auto isValue = [get](const TValue & value) {
    return [get, value](const TFilter & filter) { return (filter.*get)() == value; };
  };
  Parameter<TFilter> parameter{ name, setTo(initial), setTo(other), isValue(initial), isValue(other), {} };
  for (const TValue & value : refused)
  {
    parameter.refusals.push_back({ setTo(value), remedy });
  }
  return parameter;
}

/** A matrix of perpendicular axes, right- or left-handed. */
inline itk::Matrix<double, 3, 3>
MakeRotation(Random & random)
{
  itk::Matrix<double, 3, 3> matrix;
  matrix.SetIdentity();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double angle = Uniform(random, -0.6, 0.6);
    itk::Matrix<double, 3, 3> turn;
    turn.SetIdentity();
    const unsigned int a = (axis + 1) % 3;
    const unsigned int b = (axis + 2) % 3;
    turn[a][a] = turn[b][b] = std::cos(angle);
    turn[a][b] = std::sin(angle);
    turn[b][a] = -std::sin(angle);
    matrix = matrix * turn;
  }
  if (Integer(random, 0, 3) == 0)
  {
    for (unsigned int row = 0; row < 3; ++row)
    {
      matrix[row][0] = -matrix[row][0];
    }
  }
  return matrix;
}

/** An image anywhere in the world, whose region begins anywhere; not filled. */
template <typename TImage>
typename TImage::Pointer
MakeFrame(const SizeType & size, Random & random)
{
  auto image = TImage::New();
  RegionType region;
  typename TImage::SpacingType spacing;
  typename TImage::PointType origin;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    region.SetSize(axis, size[axis]);
    region.SetIndex(axis, Integer(random, -6, 6));
    spacing[axis] = Uniform(random, 0.7, 1.4);
    origin[axis] = Uniform(random, -50.0, 50.0);
  }
  image->SetRegions(region);
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  image->SetDirection(MakeRotation(random));
  image->Allocate();
  return image;
}

/** A gyroid, between -300 and 300, with a little noise: surfaces everywhere, and no two rows alike. Where the pixels
 * are \a labels, 1 above 0, else 0, and a few single voxels. */
template <typename TImage>
void
FillWithGyroid(TImage & image, Random & random, bool labels = false)
{
  const SizeType size = image.GetBufferedRegion().GetSize();
  std::vector<float> sine[3];
  std::vector<float> cosine[3];
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double phase = Uniform(random, 0.0, 6.0);
    const double wave = Uniform(random, 0.2, 0.35);
    for (itk::SizeValueType n = 0; n < size[axis]; ++n)
    {
      sine[axis].push_back(static_cast<float>(100.0 * std::sin(wave * static_cast<double>(n) + phase)));
      cosine[axis].push_back(static_cast<float>(std::cos(wave * static_cast<double>(n) + phase)));
    }
  }
  auto noise = static_cast<std::uint32_t>(random());
  auto * pixel = image.GetBufferPointer();
  for (itk::SizeValueType z = 0; z < size[2]; ++z)
  {
    for (itk::SizeValueType y = 0; y < size[1]; ++y)
    {
      const float perRow = sine[1][y] * cosine[2][z];
      for (itk::SizeValueType x = 0; x < size[0]; ++x, ++pixel)
      {
        noise = noise * 1664525u + 1013904223u;
        const float value = perRow + sine[0][x] * cosine[1][y] + sine[2][z] * cosine[0][x];
        *pixel = static_cast<typename TImage::PixelType>(labels ? ((value > 0.0f) != (noise >> 22 == 0) ? 1.0f : 0.0f)
                                                                : value + static_cast<float>(noise >> 28));
      }
    }
  }
}

/** What most filters need to be told: derive from it and hide what differs. */
template <typename TFilter>
struct Description
{
  using Filter = TFilter;
  using InputImage = typename TFilter::InputImageType;

  /** Whether the filter makes any part of its output from a part of its input. */
  static constexpr bool IsRegional = true;

  /** Sets what must be set before an update. */
  static void
  SetWhatHasNoDefault(Filter &)
  {}

  /** Sets what a regional filter needs to ask for parts of its input. */
  static void
  AskForParts(Filter &)
  {}

  /** For a regional filter: the most input samples that one output sample may ask for along each axis. */
  static constexpr itk::SizeValueType MostSamples = 0;

  /** What is printed beside the parameters. */
  static std::vector<std::string>
  GetResultNames()
  {
    return {};
  }

  static typename InputImage::Pointer
  MakeInput(const SizeType & size, Random & random)
  {
    const auto image = MakeFrame<InputImage>(size, random);
    FillWithGyroid(*image, random);
    return image;
  }

  /** Any good parameters, for any input of MakeInput(). */
  static void
  Vary(Filter &, const InputImage &, Random &)
  {}

  /** Parameters with which each row takes much work. */
  static void
  MakeSlow(Filter &)
  {}

  /** Whether only the thread that updates the filter looks for an abort. */
  static constexpr bool ChecksOnOneThread = false;

  /** How often each row of the output, or of the input where the output has none, is worked on with them. */
  static constexpr itk::SizeValueType PassesOverRows = 1;
};

template <typename T>
std::string
BytesOf(const T * values, std::size_t count)
{
  return std::string(reinterpret_cast<const char *>(values), count * sizeof(T));
}

inline std::string
BytesOf(const RegionType & region)
{
  return BytesOf(region.GetIndex().data(), 3) + BytesOf(region.GetSize().data(), 3);
}

/** The pixels of a part of an image's buffer. */
template <typename TImage>
std::string
BytesOf(const TImage & image, const RegionType & region)
{
  auto part = TImage::New();
  part->SetRegions(region);
  part->Allocate();
  itk::ImageAlgorithm::Copy(&image, part.GetPointer(), region, region);
  return BytesOf(part->GetBufferPointer(), region.GetNumberOfPixels());
}

/** Everything that makes an image, but its requested region. */
template <typename TImage>
std::string
Snapshot(const TImage & image)
{
  return BytesOf(image.GetLargestPossibleRegion()) + BytesOf(image.GetBufferedRegion()) +
         BytesOf(image.GetSpacing().GetDataPointer(), 3) + BytesOf(image.GetOrigin().GetDataPointer(), 3) +
         BytesOf(image.GetDirection().GetVnlMatrix().data_block(), 9) +
         BytesOf(image.GetBufferPointer(), image.GetBufferedRegion().GetNumberOfPixels());
}

inline std::string
Snapshot(const itk::TriangleSurface & surface)
{
  return BytesOf(surface.GetPoints().data(), surface.GetPoints().size()) +
         BytesOf(surface.GetNormals().data(), surface.GetNormals().size()) +
         BytesOf(surface.GetTriangles().data(), surface.GetTriangles().size());
}

/** All outputs of a filter, updated as a whole. */
template <typename TFilter>
std::string
UpdatedOutput(TFilter & filter)
{
  filter.UpdateLargestPossibleRegion();
  if constexpr (std::is_base_of_v<itk::TriangleSurfaceToTriangleSurfaceFilter, TFilter>)
  {
    return Snapshot(*filter.GetOutput());
  }
  else
  {
    std::string bytes;
    for (unsigned int n = 0; n < filter.GetNumberOfIndexedOutputs(); ++n)
    {
      bytes += Snapshot(*filter.GetOutput(n));
    }
    return bytes;
  }
}

/** A part of a region, not empty. */
inline RegionType
MakePart(const RegionType & whole, Random & random)
{
  RegionType part;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto length = static_cast<long>(whole.GetSize(axis));
    const long begin = Integer(random, 0, length - 1);
    part.SetIndex(axis, whole.GetIndex(axis) + begin);
    part.SetSize(axis, static_cast<itk::SizeValueType>(Integer(random, 1, length - begin)));
  }
  return part;
}

inline SizeType
MakeSize(Random & random, long most = 20)
{
  SizeType size;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    size[axis] = static_cast<itk::SizeValueType>(Integer(random, 1, most));
  }
  return size;
}

} // namespace filtertest

#endif
