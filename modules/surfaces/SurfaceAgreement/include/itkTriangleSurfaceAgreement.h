#ifndef itkTriangleSurfaceAgreement_h
#define itkTriangleSurfaceAgreement_h

#include "itkTriangleSurfaceDistance.h"

namespace itk
{

/** \class TriangleSurfaceAgreement
 * \brief How well two closed surfaces agree. Names and definitions are those of Metrics Reloaded (Maier-Hein et al.,
 * Nature Methods 2024), with distances between the surfaces themselves and weights by area, and not between voxels.
 * Lengths are in mm. */
struct TriangleSurfaceAgreement
{
  /** The surface that alone encloses the place where the surfaces are farthest apart. */
  enum class Side
  {
    First,
    Second
  };

  double hausdorff = 0.0;             ///< the largest distance of a point of either surface from the other surface
  double hausdorff95 = 0.0;           ///< the larger of the two directed distances that 95 % of the area do not exceed
  double meanOfMeans = 0.0;           ///< MASD: the mean of the two directed mean distances
  double pooledMean = 0.0;            ///< ASSD: the mean distance of both surfaces together
  double normalizedDice = 0;          ///< NSD: the share of both areas that is no farther away than the tolerance
  TriangleTree::PositionType worst{}; ///< a point of either surface with the Hausdorff distance, in LPS
  Side worstSide = Side::First;
};

/** Compares two surfaces. Triangles are divided until no side is longer than 6 mm (on surfaces of more than
 * 36 m^2 more), and where the distance is not linear
 * within 0.1 mm, down to sides of 0.1 mm or a quarter of the tolerance, so that neither large nor small triangles bias
 * the result. Measures of balls, boxes and rings are within 0.005 mm of the analytic ones.
 *
 * With one surface empty, or without area, distances are infinite and the normalised Dice is 0; with both empty,
 * distances are 0 and the normalised Dice is 1. Exchanging the surfaces changes worstSide only, and worst where several
 * places are equally bad. The same for any number of threads. Time O(n log n); memory some 70 bytes for each triangle
 * and part.
 *
 * \param tolerance of the normalised Dice, in mm, at least 0
 *
 * Throws ExceptionObject if a triangle refers to a missing point, and for a negative tolerance. */
TriangleSurfaceAgreement
ComputeTriangleSurfaceAgreement(const TriangleSurface & first, const TriangleSurface & second, double tolerance = 1.0);

} // namespace itk

#endif
