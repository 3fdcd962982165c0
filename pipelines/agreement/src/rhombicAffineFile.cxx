#include "rhombicAffineFile.h"

#include "rhombicFailure.h"

#include "itkTransformFileReader.h"
#include "itkTxtTransformIOFactory.h"

#include <vnl/vnl_det.h>

#include <cmath>

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

itk::TransformFileReader::TransformPointer
ReadTransform(const std::filesystem::path & path)
{
  itk::TxtTransformIOFactory::RegisterOneFactory();
  const auto reader = itk::TransformFileReader::New();
  reader->SetFileName(path.string());
  try
  {
    reader->Update();
  }
  catch (const itk::ExceptionObject & error)
  {
    Refuse(path, "cannot be read as a transform (" + DescribeError(error) + ")");
  }
  const auto & transforms = *reader->GetModifiableTransformList();
  if (transforms.size() != 1)
  {
    Refuse(path, "holds " + std::to_string(transforms.size()) + " transforms");
  }
  return transforms.front();
}

} // namespace

AffineMap::Pointer
ReadAffineMap(const std::filesystem::path & path)
{
  if (!std::filesystem::is_regular_file(path))
  {
    throw Failure(FailureKind::NotFound, "There is no file " + path.string() + "; check the path of the transform.");
  }
  const auto read = ReadTransform(path);
  const auto * const transform = dynamic_cast<const TransformType *>(read.GetPointer());
  if (transform == nullptr)
  {
    Refuse(path, "is no transform of 3-D points");
  }
  if (!transform->IsLinear())
  {
    Refuse(path, "is a transform that bends (" + std::string(transform->GetNameOfClass()) + ")");
  }
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
