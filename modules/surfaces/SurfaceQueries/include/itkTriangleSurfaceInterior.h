#ifndef itkTriangleSurfaceInterior_h
#define itkTriangleSurfaceInterior_h

#include "itkTriangleSurface.h"

#include "itkPoint.h"

#include <functional>

namespace itk
{

/** \class SamplePlanes
 * \brief Samples on parallel planes, such as the slices of a scan. All planes have the same rows and columns, but each
 * has its own origin. */
struct SamplePlanes
{
  Vector<double, 3> columnStep{}; ///< from one sample to the next along a row, in mm
  Vector<double, 3> rowStep{};    ///< from one row to the next, in mm
  SizeValueType numberOfColumns = 0;
  SizeValueType numberOfRows = 0;
  std::vector<Point<double, 3>> origins; ///< the first sample of each plane, ordered along the planes' normal
};

/** Receives samples of one row that lie inside: the columns [beginColumn, endColumn). */
using VisitInteriorSamples =
  std::function<void(SizeValueType plane, SizeValueType row, SizeValueType beginColumn, SizeValueType endColumn)>;

/** Finds the samples inside a closed surface. A sample is inside if its row crosses the surface an odd number of times
 * before it. A plane, row or sample exactly on the surface is taken to lie just above it, so that adjacent surfaces
 * share no sample. The result is undefined where the surface is open.
 *
 * Calls \a visit for the runs of each plane in order, and for several planes at once on several threads. Time and
 * memory are proportional to the triangles and the planes that each of them crosses. Exceptions of \a visit are passed
 * on. */
void
FindTriangleSurfaceInteriorSamples(const TriangleSurface & surface,
                                   const SamplePlanes & planes,
                                   const VisitInteriorSamples & visit);

} // namespace itk

#endif
