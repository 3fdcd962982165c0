#include "rhombicOptionNames.h"

#include <string_view>

namespace rhombic
{
namespace
{

struct OptionName
{
  std::string_view setting; ///< as modules name it; behind the longer names that begin with it
  std::string_view option;
};

constexpr OptionName OptionNames[] = {
  { "maximumMemory = ", "--max-memory " },
  { "temporaryFolder = ", "--temporary " },
  { "ScanReadOptions::acceptsAnalyze", "--analyze" },
  { "ScanReadOptions::followsLinks", "--follow-links" },
  { "ScanReadOptions::frame", "--frame" },
  { "ScanReadOptions::onGap", "--on-gap=interpolate" },
  { "accept ScanReadOptions::onTilted", "leave out --on-irregular=error" },
  { "accept ScanReadOptions::onUneven, in ITK pipelines by reader->AcceptUnevenOn() and "
    "lattice->SetScan(reader->GetScan()),",
    "leave out --on-irregular=error" },
  { "OMEZarrOptions::followsLinks", "--follow-links" },
  { "OMEZarrOptions::level", "--level" },
  { "OMEZarrOptions::voxelSize", "--voxel-size" },
  { "ScanReadOptions::level", "--level" },
  { "ScanReadOptions::voxelSize", "--voxel-size" },
  { "ScanReadOptions::raw", "--raw" },
  { "ScanReadOptions::series", "--series" },
  { "LabelMapSource::table", "--label-table" },
  { "leave out RemoveTable() to keep them", "--keep-table keeps them" },
  { "Denoising::Kind::Gaussian", "--denoise gaussian" },
  { "Denoising::sigma must be a positive number of mm; try 0.7",
    "The sigma of --denoise must be a positive number of mm; try gaussian:0.7 or edges:0.7,60" },
  { "Denoising::edge, the least gradient of an edge in the scan's units per mm, must be a positive number; try 60",
    "--denoise edges needs the least gradient of an edge, in the scan's units per mm: a positive number after sigma, "
    "as "
    "in edges:0.7,60" },
  { "(Denoising::sigma)", "(--denoise)" },
  { "leave out Denoising", "leave out --denoise" },
  { "SurfaceFinish::fillsCavities", "--fill" },
  { "SurfaceFinish::keepsLargestPart", "--largest" },
  { "SurfaceFinish::maximumError = ", "--max-error " },
  { "SurfaceFinish::minimumVolume = ", "--min-volume " },
  { "SurfaceFinish::minimumVolume", "--min-volume" },
  { "SurfaceFinish::share = 0.1, for example", "--max-triangles 10%" },
  { "SurfaceFinish::smoothing = ", "--smooth " },
  { "leave out the DICOM pictures", "leave out --dicom-sc" },
  { "choose pictures without transparency", "choose another --style" },
  { "choose smaller or fewer pictures", "choose a smaller --size or fewer views" },
};

} // namespace

std::string
NameOptions(std::string sentence)
{
  for (const OptionName & name : OptionNames)
  {
    for (auto place = sentence.find(name.setting); place != std::string::npos;
         place = sentence.find(name.setting, place))
    {
      sentence.replace(place, name.setting.size(), name.option);
      place += name.option.size();
    }
  }
  return sentence;
}

} // namespace rhombic
