#include "itkOMEZarrImageIOFactory.h"

#include "itkImageFileReader.h"

#include <filesystem>
#include <fstream>
#include <iostream>

/** consumer SCAN FOLDER: writes an image of one compressed chunk, 1 to 8, into the folder and reads its last voxel. */
int
main(int, char ** argv)
try
{
  const std::filesystem::path folder = argv[2];
  std::filesystem::create_directories(folder / "0");
  std::ofstream(folder / ".zattrs")
    << R"({"multiscales": [{"version": "0.4", "axes": [{"name": "z", "type": "space", "unit": "micrometer"},
           {"name": "y", "type": "space", "unit": "micrometer"}, {"name": "x", "type": "space", "unit": "micrometer"}],
           "datasets": [{"path": "0", "coordinateTransformations": [{"type": "scale", "scale": [1, 1, 1]}]}]}]})";
  std::ofstream(folder / "0/.zarray")
    << R"({"zarr_format": 2, "shape": [2, 2, 2], "chunks": [2, 2, 2], "dtype": "|u1", "compressor": {"id": "zlib"},
           "fill_value": 0, "order": "C", "filters": null})";
  constexpr unsigned char chunk[] = { 0x78, 0x9c, 0x63, 0x64, 0x62, 0x66, 0x61, 0x65,
                                      0x63, 0xe7, 0x00, 0x00, 0x00, 0x80, 0x00, 0x25 };
  std::ofstream(folder / "0/0.0.0", std::ios::binary).write(reinterpret_cast<const char *>(chunk), sizeof(chunk));

  itk::OMEZarrImageIOFactory::RegisterOneFactory();
  const auto reader = itk::ImageFileReader<itk::Image<unsigned char, 3>>::New();
  reader->SetFileName(folder.string());
  reader->Update();
  const int last = reader->GetOutput()->GetPixel({ { 1, 1, 1 } });
  std::cout << "the last voxel is " << last << '\n';
  return last == 8 ? 0 : 1;
}
catch (const std::exception & error)
{
  std::cerr << error.what() << '\n';
  return 1;
}
