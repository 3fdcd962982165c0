#ifndef rhombicSampleMean_h
#define rhombicSampleMean_h

#include "rhombicPicture.h"

namespace rhombic
{

/** Fills \a rows rows of the picture from row \a top on. Each pixel becomes the mean of samples x samples of \a drawn,
 * which has the samples of these rows alone: three bytes a sample, rows from the bottom as OpenGL has them.
 *
 * This is as fast in software as OpenGL's multisampling, which smooths outlines only and excludes depth peeling; a
 * filter such as FXAA is faster and breaks thin bones into dots. */
void
MeanOfSamples(const std::uint8_t * drawn, int samples, int top, int rows, Picture & picture);

} // namespace rhombic

#endif
