#ifndef exampleInput_h
#define exampleInput_h

#include "itkNativeScanFileReader.h"
#include "rhombicFailure.h"

#include "itkImageIOBase.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

/** Checks of arguments and inputs that the examples share. */
namespace example
{

/** Prints what went wrong in one line, and returns the exit code. */
inline int
Report(const std::exception & error)
{
  std::cerr << rhombic::DescribeError(error) << '\n';
  return 1;
}

/** An argument that is a finite number, and nothing else: "12x", and "-1" for an unsigned one, are refused. */
template <typename TNumber>
TNumber
ParseNumber(const std::string & name, const std::string & text, TNumber least = std::numeric_limits<TNumber>::lowest())
{
  TNumber number{};
  const char * const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || parsed != end || !std::isfinite(static_cast<double>(number)) || number < least)
  {
    std::ostringstream sentence;
    sentence << name << " can't be '" << text << "'; give a "
             << (std::numeric_limits<TNumber>::is_integer ? "whole number" : "number");
    if (least > std::numeric_limits<TNumber>::lowest())
    {
      sentence << " from " << least;
    }
    throw std::invalid_argument(sentence.str());
  }
  return number;
}

/** Three arguments that are a point in LPS millimetres. */
inline itk::Point<double, 3>
ParsePoint(const char * const * texts)
{
  const double point[] = { ParseNumber<double>("X", texts[0]),
                           ParseNumber<double>("Y", texts[1]),
                           ParseNumber<double>("Z", texts[2]) };
  return itk::Point<double, 3>(point);
}

/** Throws if the output is the input, or lies in the input folder. */
inline void
RequireOther(const std::filesystem::path & output, const std::vector<std::filesystem::path> & inputs)
{
  std::error_code error;
  if (!std::filesystem::exists(output, error))
  {
    return;
  }
  const auto file = std::filesystem::canonical(output);
  for (const auto & input : inputs)
  {
    for (auto place = file; place.has_relative_path(); place = place.parent_path())
    {
      if (std::filesystem::equivalent(place, input, error))
      {
        throw std::invalid_argument("The output " + output.string() + " is an input too; give it another name");
      }
    }
  }
}

/** Reads a scan in its own pixel type. */
inline rhombic::Scan
ReadScan(const std::string & path, bool acceptsUneven = true)
{
  const auto reader = itk::NativeScanFileReader::New();
  reader->SetFileName(path);
  reader->SetAcceptUneven(acceptsUneven);
  reader->Update();
  return *reader->GetOutput()->Get();
}

/** A scan for the filters of ITK, which take an image's slices for evenly spaced: others are refused. SetScan() of
 * CartesianToFCCImageFilter alone tells where they are. */
inline rhombic::Scan
ReadEvenScan(const std::string & path)
{
  return ReadScan(path, false);
}

/** The lowest value of an image, which is air in a CT. NaN is ignored. */
template <typename TImage>
typename TImage::PixelType
LowestOf(const TImage & image)
{
  auto lowest = std::numeric_limits<typename TImage::PixelType>::max();
  const auto * const samples = image.GetBufferPointer();
  std::for_each(samples, samples + image.GetBufferedRegion().GetNumberOfPixels(), [&lowest](auto sample) {
    lowest = sample < lowest ? sample : lowest;
  });
  return lowest;
}

/** Reads a file through ITK. Replaces its exceptions of several lines by one sentence. */
template <typename TRead>
void
ReadAs(const std::string & what, const std::string & path, const TRead & read)
{
  try
  {
    read();
  }
  catch (const itk::ExceptionObject &)
  {
    throw std::runtime_error(path + " can't be read as " + what + "; check its name and content");
  }
}

/** Refuses a file that itk::ImageFileReader would silently convert to a 3-D image of a pixel type. */
template <typename TPixel>
void
RequirePixels(const itk::ImageIOBase & file)
{
  const auto wanted = itk::ImageIOBase::MapPixelType<TPixel>::CType;
  if (file.GetComponentType() != wanted || file.GetNumberOfComponents() != 1 || file.GetNumberOfDimensions() != 3)
  {
    std::ostringstream sentence;
    sentence << file.GetFileName() << " holds " << file.GetNumberOfComponents() << " x "
             << file.GetComponentTypeAsString(file.GetComponentType()) << " in " << file.GetNumberOfDimensions()
             << " dimensions, but this example is for 1 x " << file.GetComponentTypeAsString(wanted)
             << " in 3; change its pixel type, or convert the file";
    throw std::runtime_error(sentence.str());
  }
}

} // namespace example

#endif
