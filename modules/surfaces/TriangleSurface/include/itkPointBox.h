#ifndef itkPointBox_h
#define itkPointBox_h

#include <algorithm>
#include <array>

namespace itk
{

/** \class PointBox
 * \brief A closed box along the axes, by its corners with the least and the greatest coordinates in mm. */
struct PointBox
{
  using PointType = std::array<float, 3>;

  PointType lowest;
  PointType highest;

  /** Enlarges the box so that it holds another box. */
  void
  Add(const PointBox & other)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      lowest[axis] = std::min(lowest[axis], other.lowest[axis]);
      highest[axis] = std::max(highest[axis], other.highest[axis]);
    }
  }

  /** Enlarges the box so that it holds a point. */
  void
  Add(const PointType & point)
  {
    this->Add(PointBox{ point, point });
  }

  /** Whether the boxes have a point in common; boxes that touch do. */
  bool
  Overlaps(const PointBox & other) const
  {
    return lowest[0] <= other.highest[0] && other.lowest[0] <= highest[0] && lowest[1] <= other.highest[1] &&
           other.lowest[1] <= highest[1] && lowest[2] <= other.highest[2] && other.lowest[2] <= highest[2];
  }

  /** Whether all of another box is in this one. */
  bool
  Holds(const PointBox & other) const
  {
    return lowest[0] <= other.lowest[0] && other.highest[0] <= highest[0] && lowest[1] <= other.lowest[1] &&
           other.highest[1] <= highest[1] && lowest[2] <= other.lowest[2] && other.highest[2] <= highest[2];
  }

  /** The axis of the longest side, the first if several are equally long. */
  unsigned int
  FindLongestAxis() const
  {
    unsigned int longest = 0;
    for (unsigned int axis = 1; axis < 3; ++axis)
    {
      longest = highest[axis] - lowest[axis] > highest[longest] - lowest[longest] ? axis : longest;
    }
    return longest;
  }
};

} // namespace itk

#endif
