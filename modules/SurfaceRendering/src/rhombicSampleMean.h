#ifndef rhombicSampleMean_h
#define rhombicSampleMean_h

#include "rhombicPicture.h"

namespace rhombic
{

/** A picture of width x height pixels, each the mean of samples x samples of \a drawn: three bytes a sample, rows from
 * the bottom as OpenGL has them.
 *
 * This is as fast in software as OpenGL's multisampling, which smooths outlines only and excludes depth peeling; a
 * filter such as FXAA is faster and breaks thin bones into dots. */
Picture
MeanOfSamples(const std::uint8_t * drawn, int width, int height, int samples);

} // namespace rhombic

#endif
