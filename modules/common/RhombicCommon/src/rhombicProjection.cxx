#include "rhombicProjection.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

Vector3
Opposite(const Vector3 & direction)
{
  return { -direction[0], -direction[1], -direction[2] };
}

} // namespace

std::string
LettersOf(const Vector3 & direction, double smallest)
{
  constexpr char letters[3][2] = { { 'R', 'L' }, { 'A', 'P' }, { 'F', 'H' } };
  const double length = std::sqrt(Dot(direction, direction));
  std::array<int, 3> axes{ 0, 1, 2 };
  std::stable_sort(
    axes.begin(), axes.end(), [&direction](int a, int b) { return std::abs(direction[a]) > std::abs(direction[b]); });
  std::string text;
  for (const int axis : axes)
  {
    if (text.empty() || std::abs(direction[axis]) >= smallest * length)
    {
      text += letters[axis][direction[axis] > 0.0];
    }
  }
  return text;
}

EdgeLetters
EdgeLettersOf(const ViewFrame & frame)
{
  return {
    LettersOf(Opposite(frame.right)), LettersOf(frame.right), LettersOf(frame.up), LettersOf(Opposite(frame.up))
  };
}

PicturePosition
Projection::PositionOf(const Vector3 & point) const
{
  const Vector3 offset{ point[0] - centre[0], point[1] - centre[1], point[2] - centre[2] };
  return { 0.5 * width + Dot(offset, frame.right) / pixelSize, 0.5 * height - Dot(offset, frame.up) / pixelSize };
}

Vector3
Projection::PointAt(const PicturePosition & position) const
{
  const double right = (position.x - 0.5 * width) * pixelSize;
  const double up = (0.5 * height - position.y) * pixelSize;
  Vector3 point;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    point[axis] = centre[axis] + right * frame.right[axis] + up * frame.up[axis];
  }
  return point;
}

} // namespace rhombic
