#include "itkFCCLinearField.h"
#include "rhombicFCCImageFile.h"
#include "rhombicTemporaryFolder.h"

#include "itkImageFileReader.h"
#include "itkImageFileWriter.h"
#include "itkMetaDataObject.h"
#include "itkNrrdImageIO.h"

#include <gtest/gtest.h>

#include <cstring>

/** Files of lattice volumes as programs see them that know nothing of the lattice. */
namespace
{

using LatticeType = itk::FCCImage<float>;
using GridType = itk::Image<float, 3>;

GridType::Pointer
ReadAsGrid(const std::filesystem::path & path)
{
  const auto reader = itk::ImageFileReader<GridType>::New();
  reader->SetFileName(path);
  reader->SetImageIO(itk::NrrdImageIO::New());
  reader->Update();
  return reader->GetOutput();
}

/** Expects the samples of a lattice in a grid, and tells how far those of the rows of parity 0 are from where they
 * belong, at most. */
double
CompareWithGrid(const LatticeType & lattice, const GridType & grid)
{
  const auto region = lattice.GetBufferedRegion();
  EXPECT_EQ(grid.GetBufferedRegion().GetSize(), region.GetSize());
  const auto bytes = region.GetNumberOfPixels() * sizeof(float);
  EXPECT_EQ(std::memcmp(grid.GetBufferPointer(), lattice.GetBufferPointer(), bytes), 0);
  double farthest = 0.0;
  for (itk::ImageRegionConstIteratorWithIndex<LatticeType> it(&lattice, region); !it.IsAtEnd(); ++it)
  {
    const auto & index = it.GetIndex();
    if (itk::FCCLattice::Parity(index[1], index[2]) == 0)
    {
      const auto inGrid = grid.GetBufferedRegion().GetIndex() + (index - region.GetIndex());
      farthest = std::max(farthest,
                          lattice.TransformIndexToPhysicalPoint<double>(index).EuclideanDistanceTo(
                            grid.TransformIndexToPhysicalPoint<double>(inGrid)));
    }
  }
  return farthest;
}

TEST(FCCFiles, OtherReadersOfNRRDSeeTheSamples)
{
  const rhombictest::TemporaryFolder folder;
  const auto path = folder.Path() / "volume.fcc.nrrd";
  const auto lattice = fcctest::MakeTurnedLinearField();
  rhombic::WriteFCCImage(lattice, path);
  const auto grid = ReadAsGrid(path);
  EXPECT_LT(CompareWithGrid(*lattice, *grid), 1e-9);
  std::string kind;
  EXPECT_TRUE(itk::ExposeMetaData(grid->GetMetaDataDictionary(), "lattice", kind));
  EXPECT_EQ(kind, "fcc parity rows");
}

TEST(FCCFiles, WritersOfITKKeepTheSamplesButNotTheirPlaces)
{
  const rhombictest::TemporaryFolder folder;
  const auto path = folder.Path() / "volume.nrrd";
  const auto lattice = fcctest::MakeTurnedLinearField();
  const auto writer = itk::ImageFileWriter<LatticeType>::New();
  writer->SetInput(lattice);
  writer->SetImageIO(itk::NrrdImageIO::New());
  writer->SetFileName(path);
  writer->Update();
  EXPECT_GT(CompareWithGrid(*lattice, *ReadAsGrid(path)), 1.0);
  EXPECT_FALSE(rhombic::IsFCCImageFile(path));
}

} // namespace
