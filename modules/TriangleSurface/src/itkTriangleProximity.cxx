#include "itkTriangleProximity.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

using Corners = std::array<PositionType, 3>;

constexpr unsigned int MostCuts = 13;
constexpr double NearForCentres = 0.9;   // of the distance
constexpr double SmallestPiece = 0.1125; // of the distance; no place is further from the centre than 0.58 of that

double
SquaredDistance(const PositionType & a, const PositionType & b)
{
  const PositionType way = Subtract(a, b);
  return Dot(way, way);
}

PositionType
Middle(const PositionType & a, const PositionType & b)
{
  return { 0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2]) };
}

class Proof
{
public:
  Proof(const TriangleTree & surface, double distance)
    : m_Surface(surface)
    , m_SquaredDistance(distance * distance)
  {}

  bool
  IsNear(const Corners & piece, unsigned int cutsLeft) const
  {
    const auto & [a, b, c] = piece;
    const PositionType centre{ (a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0, (a[2] + b[2] + c[2]) / 3.0 };
    const auto nearest =
      m_Surface.FindClosestPoint(centre, NearForCentres * NearForCentres * m_SquaredDistance).triangle;
    if (nearest == TriangleTree::None)
    {
      return false;
    }
    const double longest = std::max({ SquaredDistance(a, b), SquaredDistance(b, c), SquaredDistance(c, a) });
    if (longest <= SmallestPiece * SmallestPiece * m_SquaredDistance ||
        std::all_of(piece.begin(), piece.end(), [&](const PositionType & corner) {
          return SquaredDistance(corner, m_Surface.FindClosestPointOfTriangle(corner, nearest)) <= m_SquaredDistance;
        }))
    {
      return true;
    }
    if (cutsLeft == 0)
    {
      return false;
    }
    const PositionType ab = Middle(a, b);
    const PositionType bc = Middle(b, c);
    const PositionType ca = Middle(c, a);
    return this->IsNear({ ab, bc, ca }, cutsLeft - 1) && this->IsNear({ a, ab, ca }, cutsLeft - 1) &&
           this->IsNear({ ab, b, bc }, cutsLeft - 1) && this->IsNear({ ca, bc, c }, cutsLeft - 1);
  }

private:
  const TriangleTree & m_Surface;
  const double m_SquaredDistance;
};

} // namespace

bool
IsWithinDistance(const Corners & corners, const TriangleTree & surface, double distance)
{
  return Proof(surface, distance).IsNear(corners, MostCuts);
}

} // namespace itk
