#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicPictureComparison.h"
#include "rhombicPictureIO.h"
#include "rhombicWording.h"

#include <cmath>
#include <iostream>

namespace rhombic
{
namespace
{

constexpr double LevelsOfComponent = 255.0;

struct ComparePicturesOptions
{
  std::string first;
  std::string second;
  double tolerance = 0.0;
  bool isJson = false;
};

void
Compare(const ComparePicturesOptions & options)
{
  if (options.first.empty() || options.second.empty())
  {
    throw Failure(FailureKind::Usage, "Two pictures are needed; name both files.");
  }
  const auto difference = ComparePictures(
    ReadPicture(options.first), ReadPicture(options.second), (options.tolerance + 0.5) / LevelsOfComponent);
  const double mean = difference.meanError * LevelsOfComponent;
  const long largest = std::lround(difference.maxError * LevelsOfComponent);
  if (options.isJson)
  {
    const Report report{ { "meanDifference", mean },
                         { "largestDifference", largest },
                         { "pixelsAboveTolerance", difference.differingPixels },
                         { "toleranceOf255", options.tolerance } };
    std::cout << ToJson(report) << '\n';
  }
  else
  {
    std::cout << "mean difference " << FormatNumber(mean, 3) << ", largest " << largest << " of 255, "
              << Count(difference.differingPixels, "pixel") << " above the tolerance\n";
  }
  if (difference.differingPixels > 0)
  {
    throw Failure(FailureKind::Different,
                  Count(difference.differingPixels, "pixel differs", "pixels differ") + " by more than " +
                    FormatNumber(options.tolerance) + " of 255, most in column " + std::to_string(difference.worstX) +
                    ", row " + std::to_string(difference.worstY) + "; a larger --tolerance accepts that.");
  }
}

} // namespace

CommandRun
AddComparePicturesCommand(CommandSettings & command)
{
  static const SettingsTable<ComparePicturesOptions> table{
    { "FIRST", &ComparePicturesOptions::first, "a picture" },
    { "SECOND", &ComparePicturesOptions::second, "another one of the same size" },
    { "--tolerance",
      &ComparePicturesOptions::tolerance,
      "largest difference of a red, green, blue or alpha value, 0 to 255",
      Checked(CLI::Range(0.0, 255.0)),
      ShowingDefault },
    { "--json", &ComparePicturesOptions::isJson, "the differences as JSON" },
  };
  const auto options = std::make_shared<ComparePicturesOptions>();
  command.Add(table, *options);
  return WithoutOutputs([options](const CommandContext &) { Compare(*options); });
}

} // namespace rhombic
