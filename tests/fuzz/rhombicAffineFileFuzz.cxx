#include "rhombicAffineFile.h"
#include "rhombicFailure.h"
#include "rhombicFuzzFile.h"

#include <cmath>

using rhombicfuzz::Require;

/** Transforms of ITK in text. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  const rhombicfuzz::FuzzFile file(data, size);
  try
  {
    const rhombic::AffineMap::Pointer map = rhombic::ReadAffineMap(file.Path());
    for (unsigned int row = 0; row < 3; ++row)
    {
      Require(std::isfinite(map->GetOffset()[row]), "the offset is finite");
      for (unsigned int column = 0; column < 3; ++column)
      {
        Require(std::isfinite(map->GetMatrix()[row][column]), "the matrix is finite");
      }
    }
    Require(rhombic::InverseOf(*map).IsNotNull(), "the map can be inverted");
  }
  catch (const rhombic::Failure & failure)
  {
    Require(failure.GetKind() == rhombic::FailureKind::Unreadable, "a bad transform is unreadable");
  }
  return 0;
}
