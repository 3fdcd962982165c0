#include "rhombicThumbnail.h"

#include <algorithm>
#include <array>

namespace rhombic
{
namespace
{

Picture
Shrink(const Picture & picture, int side)
{
  const int block = (std::max(picture.width, picture.height) + side - 1) / side;
  Picture small(std::max(1, picture.width / block), std::max(1, picture.height / block), 3);
  const int columns = std::min(block, picture.width);
  const int rows = std::min(block, picture.height);
  auto component = small.pixels.begin();
  for (int y = 0; y < small.height; ++y)
  {
    for (int x = 0; x < small.width; ++x)
    {
      std::array<int, 3> sums{};
      for (int row = 0; row < rows; ++row)
      {
        const std::uint8_t * pixel = picture.At(x * block, y * block + row);
        for (int column = 0; column < columns; ++column, pixel += picture.channels)
        {
          sums = { sums[0] + pixel[0], sums[1] + pixel[1], sums[2] + pixel[2] };
        }
      }
      component = std::transform(sums.begin(), sums.end(), component, [&](int sum) {
        return static_cast<std::uint8_t>(sum / (columns * rows));
      });
    }
  }
  return small;
}

} // namespace

void
StageThumbnail(const std::vector<Picture> & pictures,
               const std::filesystem::path & path,
               StagedFiles & staged,
               std::vector<MadeFile> & outputs)
{
  constexpr int side = 320; // pixels
  if (!pictures.empty() && !path.empty())
  {
    StagePicture(Shrink(pictures.front(), side), path, staged, {});
    outputs.push_back({ path, "thumbnail", Report::array(), false });
  }
}

} // namespace rhombic
