#include "rhombicProjection.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{

std::string
LettersOf(const Vector3 & direction, double smallest)
{
  constexpr char letters[3][2] = { { 'R', 'L' }, { 'A', 'P' }, { 'F', 'H' } };
  const double length = Length(direction);
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
    LettersOf(Scaled(frame.right, -1.0)), LettersOf(frame.right), LettersOf(frame.up), LettersOf(Scaled(frame.up, -1.0))
  };
}

PicturePosition
Projection::PositionOf(const Vector3 & point) const
{
  const Vector3 offset = Subtract(point, centre);
  return { 0.5 * width + Dot(offset, frame.right) / pixelSize, 0.5 * height - Dot(offset, frame.up) / pixelSize };
}

Vector3
Projection::PointAt(const PicturePosition & position) const
{
  const double right = (position.x - 0.5 * width) * pixelSize;
  const double up = (0.5 * height - position.y) * pixelSize;
  return Along(Along(centre, frame.right, right), frame.up, up);
}

} // namespace rhombic
