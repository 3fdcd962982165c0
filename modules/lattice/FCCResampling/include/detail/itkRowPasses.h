#ifndef itkRowPasses_h
#define itkRowPasses_h

#include "detail/itkFCCGaussianTaps.h"
#include "itkImageRegion.h"

#include <functional>

namespace itk
{

/** \file
 * The loops of the resampling filters: passes over whole rows along one axis after the other. Nothing here depends on
 * pixel types: each function gets its input rows as float from one function and gives its output rows to another
 * function. Any part of an output has the same bytes whether it is made alone or with the rest. */

/** Writes \a length samples of the input, from \a start on along x, to \a row as float. */
using LoadRow = std::function<void(const Index<3> & start, SizeValueType length, float * row)>;

/** Takes the values of \a length samples of the output, from \a start on along x. Called once for each row. */
using StoreRow = std::function<void(const Index<3> & start, SizeValueType length, const float * values)>;

/** Smooths an FCC image with a Gaussian: along y, z and x in turn. Sites outside the image are mirrored.
 *
 * \param whole region of the image
 * \param region to be smoothed, a part of it, not empty
 * \param load is asked for samples of taps.AddReach(region, whole) by their indices, always for whole rows of it */
void
SmoothRows(const FCCGaussianTaps & taps,
           const ImageRegion<3> & whole,
           const ImageRegion<3> & region,
           const LoadRow & load,
           const StoreRow & store);

/** How far the half-band filter reaches along each axis, in samples. */
constexpr IndexValueType HalfBandReach = 3;

/** Applies the half-band filter of CartesianToNestedFCCImageFilter at the sites of a region. The input is continued by
 * its mirror image.
 *
 * \param size of the input
 * \param region of the nested lattice, not empty
 * \param load is asked for samples counted from the input's first sample */
void
FilterHalfBandRows(const Size<3> & size, const ImageRegion<3> & region, const LoadRow & load, const StoreRow & store);

} // namespace itk

#endif
