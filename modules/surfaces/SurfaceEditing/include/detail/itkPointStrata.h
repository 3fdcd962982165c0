#ifndef itkPointStrata_h
#define itkPointStrata_h

#include "detail/itkTrianglesOfPoints.h"

#include <algorithm>

namespace itk
{

/** Where a point lies in a surface. Points may move and edges collapse within a stratum only. */
enum class Stratum : std::uint8_t
{
  Sheet, ///< inside: its triangles are one closed fan, all of one orientation
  Curve, ///< sheets meet: its triangles are three or more fans that end at the same two neighbours
  Fixed  ///< on an open border, where curves meet or end, or not manifold
};

/** A point of a curve and its neighbours on the curve, ascending. */
struct CurvePoint
{
  std::uint32_t point;
  std::array<std::uint32_t, 2> neighbours;
};

/** The stratum of each point, and the points of curves, ascending. */
struct PointStrata
{
  BulkVector<Stratum> strata;
  std::vector<CurvePoint> curves;
};

PointStrata
FindStrata(const TriangleSurface & surface, const TrianglesOfPoints & fans);

} // namespace itk

#endif
