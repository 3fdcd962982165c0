#include "rhombicAffineFile.h"

#include "rhombicFailure.h"
#include "rhombicFiles.h"
#include "rhombicWording.h"

#include "itkTransform.h"
#include "itkTransformFactoryBase.h"

#include <vnl/vnl_det.h>

#include <cmath>
#include <map>
#include <string_view>

namespace rhombic
{
namespace
{

using TransformType = itk::Transform<double, 3, 3>;

[[noreturn]] void
Refuse(const std::filesystem::path & path, const std::string & why)
{
  throw Failure(FailureKind::Unreadable,
                path.string() + " " + why +
                  "; a comparison takes one rigid or affine transform of ITK in text, as itk::TransformFileWriter "
                  "writes it (.tfm).");
}

/** A transform in ITK's text format. */
struct TransformText
{
  std::string className;
  TransformType::ParametersType parameters;
  TransformType::FixedParametersType fixedParameters;
};

/** The numbers of a line; refuses other words, and numbers that are not finite. */
itk::OptimizerParameters<double>
ReadNumbers(const std::filesystem::path & path, std::string_view line)
{
  const std::vector<std::string_view> words = SplitWords(line);
  itk::OptimizerParameters<double> numbers(words.size());
  for (std::size_t n = 0; n < words.size(); ++n)
  {
    const auto number = ToNumber<double>(words[n]);
    if (!number || !std::isfinite(*number))
    {
      Refuse(path, "has \"" + std::string(words[n]) + "\" among its parameters");
    }
    numbers[static_cast<unsigned int>(n)] = *number;
  }
  return numbers;
}

/** Reads lines `Transform: CLASS`, `Parameters: NUMBERS` and `FixedParameters: NUMBERS`, one of each at most, and
 * comments after #. */
TransformText
ReadTransformText(const std::filesystem::path & path)
{
  constexpr std::size_t mostBytes = 1 << 20;
  std::map<std::string, std::string> values;
  for (const std::string & line : Split(ReadTextFile(path, "transform", mostBytes), "\r\n"))
  {
    if (Trim(line).empty() || line.front() == '#')
    {
      continue;
    }
    const std::size_t colon = line.find(':');
    const std::string key = line.substr(0, colon);
    if (colon == std::string::npos || (key != "Transform" && key != "Parameters" && key != "FixedParameters"))
    {
      Refuse(path, "cannot be read as a transform (" + key + ")");
    }
    if (!values.emplace(key, line.substr(colon + 1)).second)
    {
      Refuse(path, "holds several transforms");
    }
  }
  return { std::string(Trim(values["Transform"])),
           ReadNumbers(path, values["Parameters"]),
           ReadNumbers(path, values["FixedParameters"]) };
}

/** Makes a transform of ITK as itk::TransformFileReader does. That reader is not used: it ends the program for a file
 * with fewer parameters than the transform has. */
TransformType::Pointer
ReadTransform(const std::filesystem::path & path)
{
  const TransformText text = ReadTransformText(path);
  std::string className = text.className;
  if (const std::size_t precision = className.find("_float_"); precision != std::string::npos)
  {
    className.replace(precision, 7, "_double_");
  }
  itk::TransformFactoryBase::RegisterDefaultTransforms();
  const itk::LightObject::Pointer made = itk::ObjectFactoryBase::CreateInstance(className.c_str());
  if (made)
  {
    made->UnRegister(); // CreateInstance() counts a reference that nobody holds
  }
  const TransformType::Pointer transform = dynamic_cast<TransformType *>(made.GetPointer());
  if (!transform)
  {
    Refuse(path, "is no transform of 3-D points (" + text.className + ")");
  }
  if (!transform->IsLinear())
  {
    Refuse(path, "is a transform that bends (" + std::string(transform->GetNameOfClass()) + ")");
  }
  const auto fixed = transform->GetFixedParameters().size();
  const bool isOfITK4 = fixed == 4 && text.fixedParameters.size() == 3; // Euler3DTransform without the order of angles
  if (text.parameters.size() != transform->GetNumberOfParameters() ||
      (text.fixedParameters.size() != fixed && !isOfITK4))
  {
    Refuse(path,
           "has " + std::to_string(text.parameters.size()) + " parameters and " +
             std::to_string(text.fixedParameters.size()) + " fixed ones, where " + text.className + " has " +
             std::to_string(transform->GetNumberOfParameters()) + " and " + std::to_string(fixed));
  }
  try
  {
    transform->SetFixedParameters(text.fixedParameters);
    transform->SetParameters(text.parameters);
  }
  catch (const itk::ExceptionObject & error)
  {
    Refuse(path, "cannot be read as a transform (" + DescribeError(error) + ")");
  }
  return transform;
}

} // namespace

AffineMap::Pointer
ReadAffineMap(const std::filesystem::path & path)
{
  const auto transform = ReadTransform(path);
  TransformType::InputPointType zero;
  zero.Fill(0.0);
  const auto origin = transform->TransformPoint(zero);
  AffineMap::MatrixType matrix;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    auto unit = zero;
    unit[axis] = 1.0;
    const auto column = transform->TransformPoint(unit) - origin;
    for (unsigned int row = 0; row < 3; ++row)
    {
      matrix[row][axis] = column[row];
    }
  }
  if (!(std::abs(vnl_det(matrix.GetVnlMatrix())) > 1e-9))
  {
    Refuse(path, "is a transform that cannot be inverted");
  }
  const auto map = AffineMap::New();
  map->SetMatrix(matrix);
  map->SetOffset(origin.GetVectorFromOrigin());
  return map;
}

AffineMap::Pointer
InverseOf(const AffineMap & map)
{
  const auto inverse = AffineMap::New();
  map.GetInverse(inverse);
  return inverse;
}

} // namespace rhombic
