#ifndef rhombicStackTest_h
#define rhombicStackTest_h

#include "itkScanFileReader.h"
#include "rhombicDicomTestFile.h"
#include "rhombicScanTest.h"
#include "rhombicScanWriter.h"

#include <random>
#include <vector>

/** Tests with a small scan in each format. */
class StackTest : public ScanTest
{
protected:
  static constexpr std::size_t Slices = 8;
  static constexpr std::uint16_t Columns = 7;
  static constexpr std::uint16_t Rows = 6;

  /** Where the slices of uneven stacks lie along z, in mm. */
  static constexpr double Positions[Slices] = { 0, 2, 4, 6, 9, 12, 15, 18 };

  /** Writes a stack of random values from -1000 to 1000, whose slices are 2.5 mm apart or at Positions. */
  std::filesystem::path
  WriteStack(const std::string & name, bool isUneven = false) const
  {
    const std::filesystem::path folder = m_Folder / name;
    std::filesystem::create_directories(folder);
    std::mt19937 random(5);
    for (std::size_t k = 0; k < Slices; ++k)
    {
      DicomTestFile file(Columns, Rows);
      std::vector<std::int16_t> pixels(std::size_t{ Columns } * Rows);
      for (std::int16_t & pixel : pixels)
      {
        pixel = static_cast<std::int16_t>(24 + random() % 2001);
      }
      file.SetPixels(pixels);
      file.SetPosition("5\\-3\\" + std::to_string(isUneven ? Positions[k] : 2.5 * static_cast<double>(k)));
      file.Write(folder / (std::to_string(k * 3 % Slices) + ".dcm"));
    }
    return folder;
  }

  /** The same scan in each format. */
  std::vector<std::filesystem::path>
  WriteAll() const
  {
    using ImageType = itk::Image<std::int16_t, 3>;
    std::vector<std::filesystem::path> paths{ this->WriteStack("dicom") };
    const auto reader = itk::ScanFileReader<ImageType>::New();
    reader->SetFileName(paths.front().string());
    reader->Update();
    const rhombic::ScanImage image = ImageType::Pointer(reader->GetOutput());
    for (const char * const name : { "scan.nii", "scan.nii.gz", "scan.nrrd", "scan.mha" })
    {
      paths.push_back(m_Folder / name);
      rhombic::WriteScan(image, paths.back());
    }
    return paths;
  }
};

#endif
