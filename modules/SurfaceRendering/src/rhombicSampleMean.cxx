#include "rhombicSampleMean.h"

namespace rhombic
{
namespace
{

/** The mean of a channel over a square of samples; \a first points to the channel of the first sample. */
std::uint8_t
MeanOfSquare(const std::uint8_t * first, std::size_t rowBytes, int samples)
{
  const int count = samples * samples;
  int sum = count / 2;
  for (int row = 0; row < samples; ++row, first += rowBytes)
  {
    for (int column = 0; column < samples; ++column)
    {
      sum += first[column * Picture::Channels];
    }
  }
  return static_cast<std::uint8_t>(sum / count);
}

} // namespace

void
MeanOfSamples(const std::uint8_t * drawn, int samples, int top, int rows, Picture & picture)
{
  const std::size_t pixelBytes = static_cast<std::size_t>(samples) * Picture::Channels;
  const std::size_t rowBytes = static_cast<std::size_t>(picture.width) * pixelBytes;
  std::uint8_t * target =
    picture.pixels.data() + static_cast<std::size_t>(top) * static_cast<std::size_t>(picture.width) * Picture::Channels;
  for (int y = rows - 1; y >= 0; --y)
  {
    const std::uint8_t * square = drawn + static_cast<std::size_t>(y) * static_cast<std::size_t>(samples) * rowBytes;
    for (int x = 0; x < picture.width; ++x, square += pixelBytes)
    {
      for (int channel = 0; channel < Picture::Channels; ++channel)
      {
        *target++ = MeanOfSquare(square + channel, rowBytes, samples);
      }
    }
  }
}

} // namespace rhombic
