#ifndef rhombicSampleMean_h
#define rhombicSampleMean_h

#include "rhombicPicture.h"

namespace rhombic
{

/** Fills \a rows rows of the picture from row \a top on. Each pixel becomes the mean of samples x samples of \a drawn,
 * which holds the samples of these rows only: three bytes per sample, rows from the bottom as in OpenGL.
 *
 * In software this is as fast as OpenGL's multisampling, which smooths outlines only and does not work with depth
 * peeling. A filter such as FXAA is faster, but breaks thin bones into dots. */
void
MeanOfSamples(const std::uint8_t * drawn, int samples, int top, int rows, Picture & picture);

} // namespace rhombic

#endif
