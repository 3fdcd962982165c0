#ifndef itkTriangleSurfaceInterior_h
#define itkTriangleSurfaceInterior_h

#include "itkTriangleSurface.h"

#include "itkPoint.h"

#include <functional>

namespace itk
{

/** \class SamplePlanes
 * \brief Samples on parallel planes, as the slices of a scan: the same rows and columns on each, which may lie anywhere
 * in its plane.
 *
 * Thread safety: a value. */
struct SamplePlanes
{
  Vector<double, 3> columnStep{}; ///< from sample to sample along a row, in mm
  Vector<double, 3> rowStep{};    ///< from row to row
  SizeValueType numberOfColumns = 0;
  SizeValueType numberOfRows = 0;
  std::vector<Point<double, 3>> origins; ///< the first sample of each plane, in order along the planes' normal
};

/** Samples of one row that lie inside: columns from begin, without end. */
using VisitInteriorSamples =
  std::function<void(SizeValueType plane, SizeValueType row, SizeValueType beginColumn, SizeValueType endColumn)>;

/** Finds the samples inside a closed surface. A sample is inside when the surface is crossed an odd number of times on
 * the way to it along its row; each plane, row and sample on the surface itself counts to its upper side, so that
 * neighbouring surfaces share no sample. Where the surface is open, what is inside is not defined.
 *
 * \a visit gets the runs of each plane in order, on several threads for several planes (itk::MultiThreaderBase). Time
 * and memory are proportional to the triangles and the planes each of them crosses. Throws what \a visit throws. Thread
 * safe. */
void
FindInteriorSamples(const TriangleSurface & surface, const SamplePlanes & planes, const VisitInteriorSamples & visit);

} // namespace itk

#endif
