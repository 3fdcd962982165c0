#include "itkOMEZarrImageIO.h"
#include "itkOMEZarrImageIOFactory.h"

#include "itkRefusal.h"
#include "rhombicFailure.h"
#include "rhombicOMEZarrTestFolder.h"
#include "rhombicTemporaryFolder.h"

#include "itkImageFileReader.h"
#include "itkImageRegionConstIteratorWithIndex.h"

#include <gtest/gtest.h>

#include <numeric>
#include <array>
#include <sstream>

/** itk::ImageFileReader with OMEZarrImageIO. */
namespace
{

namespace fs = std::filesystem;
using rhombictest::OMEZarrTestFolder;
using ImageType = itk::Image<std::uint16_t, 3>;

class OMEZarrImageIO : public testing::Test
{
private:
  const rhombictest::TemporaryFolder m_TemporaryFolder;

protected:
  OMEZarrImageIO()
  {
    std::iota(m_Values.begin(), m_Values.end(), 1);
    m_Zarr.Write(m_Folder, m_Values);
  }

  const fs::path m_Folder = m_TemporaryFolder.Path() / "image.zarr";
  OMEZarrTestFolder m_Zarr;
  std::vector<std::uint16_t> m_Values = std::vector<std::uint16_t>(120);
};

TEST_F(OMEZarrImageIO, IsABasicObjectOfITKThatWritesNothing)
{
  const auto io = itk::OMEZarrImageIO::New();
  EXPECT_STREQ(io->GetNameOfClass(), "OMEZarrImageIO");
  EXPECT_NE(dynamic_cast<itk::OMEZarrImageIO *>(io->CreateAnother().GetPointer()), nullptr);
  EXPECT_EQ(io->GetLevel(), 0u);
  EXPECT_EQ(io->GetFrame(), 0u);
  std::ostringstream text;
  io->Print(text);
  EXPECT_NE(text.str().find("VoxelSize: [0, 0, 0]"), std::string::npos);
  EXPECT_TRUE(io->CanReadFile(m_Folder.c_str()));
  EXPECT_FALSE(io->CanReadFile(m_Folder.parent_path().c_str()));
  EXPECT_FALSE(io->CanReadFile("image.nrrd"));
  EXPECT_FALSE(io->CanWriteFile("image.zarr"));
  EXPECT_NE(Refusal([&] { io->WriteImageInformation(); }), "");
  EXPECT_NE(Refusal([&] { io->Write(nullptr); }), "");
  EXPECT_NE(Refusal([&] { io->Read(nullptr); }).find("ReadImageInformation()"), std::string::npos);
}

TEST_F(OMEZarrImageIO, ServesImageFileReaderOnceItIsRegistered)
{
  itk::OMEZarrImageIOFactory::RegisterOneFactory();
  itk::OMEZarrImageIOFactory::RegisterOneFactory();
  const auto reader = itk::ImageFileReader<ImageType>::New();
  reader->SetFileName(m_Folder.string());
  reader->Update();
  EXPECT_STREQ(reader->GetImageIO()->GetNameOfClass(), "OMEZarrImageIO");
  EXPECT_EQ(reader->GetImageIO()->GetComponentType(), itk::IOComponentEnum::USHORT);
  const ImageType & image = *reader->GetOutput();
  EXPECT_EQ(image.GetLargestPossibleRegion().GetSize(), (itk::Size<3>{ { 6, 5, 4 } }));
  EXPECT_EQ(image.GetSpacing(), (itk::Vector<double, 3>(std::array<double, 3>{ 0.002, 0.003, 0.004 }.data())));
  EXPECT_TRUE(std::equal(m_Values.begin(), m_Values.end(), image.GetBufferPointer()));
  std::size_t count = 0;
  for (itk::ObjectFactoryBase * const factory : itk::ObjectFactoryBase::GetRegisteredFactories())
  {
    if (dynamic_cast<itk::OMEZarrImageIOFactory *>(factory) != nullptr)
    {
      ++count;
      itk::ObjectFactoryBase::UnRegisterFactory(factory);
    }
  }
  EXPECT_EQ(count, 1u);
}

TEST_F(OMEZarrImageIO, ReadsARegionFromItsChunksAlone)
{
  fs::remove(m_Folder / "0/0/0/0");
  OMEZarrTestFolder::WriteText(m_Folder / "0/0/0/0", "damaged");
  const auto reader = itk::ImageFileReader<ImageType>::New();
  reader->SetImageIO(itk::OMEZarrImageIO::New());
  reader->SetFileName(m_Folder.string());
  reader->UpdateOutputInformation();
  EXPECT_TRUE(reader->GetImageIO()->CanStreamRead());
  const itk::ImageRegion<3> region({ { 1, 1, 2 } }, { { 4, 3, 2 } });
  reader->GetOutput()->SetRequestedRegion(region);
  reader->GetOutput()->Update();
  ASSERT_EQ(reader->GetOutput()->GetBufferedRegion(), region);
  for (itk::ImageRegionConstIteratorWithIndex<ImageType> voxel(reader->GetOutput(), region); !voxel.IsAtEnd(); ++voxel)
  {
    const auto & index = voxel.GetIndex();
    ASSERT_EQ(voxel.Get(), m_Values[(index[2] * 5 + index[1]) * 6 + index[0]]) << index;
  }
  EXPECT_NE(Refusal([&] { reader->UpdateLargestPossibleRegion(); }).find("0/0/0/0"), std::string::npos);
}

TEST_F(OMEZarrImageIO, LevelFrameAndVoxelSize)
{
  m_Zarr.shape = { 2, 2, 3, 4 };
  m_Zarr.chunks = { 1, 2, 3, 4 };
  m_Zarr.axes = R"([{"name": "c", "type": "channel"}, {"name": "z"}, {"name": "y"}, {"name": "x"}])";
  m_Zarr.transformations = "[]";
  m_Zarr.WriteArray(m_Folder / "1", std::vector<std::uint16_t>(m_Values.begin(), m_Values.begin() + 48));
  OMEZarrTestFolder::WriteText(m_Folder / ".zattrs", m_Zarr.Attributes(2));
  const auto io = itk::OMEZarrImageIO::New();
  io->SetFileName(m_Folder.string());
  io->SetLevel(1);
  io->SetFrame(1);
  EXPECT_NE(Refusal([&] { io->ReadImageInformation(); }).find("voxelSize"), std::string::npos);
  io->SetVoxelSize((itk::Vector<double, 3>(std::array<double, 3>{ 1.0, 2.0, 3.0 }.data())));
  const auto reader = itk::ImageFileReader<ImageType>::New();
  reader->SetImageIO(io);
  reader->SetFileName(m_Folder.string());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetSpacing(), (itk::Vector<double, 3>(std::array<double, 3>{ 1.0, 2.0, 3.0 }.data())));
  EXPECT_EQ(reader->GetOutput()->GetPixel({ { 0, 0, 0 } }), 25);
  io->SetFrame(2);
  EXPECT_NE(Refusal([&] { io->ReadImageInformation(); }).find("volume 2"), std::string::npos);
}

} // namespace
