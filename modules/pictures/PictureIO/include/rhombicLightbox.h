#ifndef rhombicLightbox_h
#define rhombicLightbox_h

#include "rhombicPicture.h"

#include <vector>

namespace rhombic
{

/** The number of columns in which \a count tiles make a lightbox nearest to \a aspect, the width of all divided by
 * their height. Tiles have \a width x \a height pixels. Empty places count against a number of columns. */
int
LightboxColumns(int count, int width, int height, double aspect = 4.0 / 3.0);

/** Pictures in rows from the top left, with \a gap pixels of \a background or more between and around them. Places have
 * the size of the largest picture; smaller ones are in their middle. The lightbox has 4 channels when any picture has,
 * and is transparent there where nothing lies. \a columns 0: LightboxColumns().
 *
 * Throws Failure(Usage) when there is no picture. */
Picture
MakeLightbox(const std::vector<Picture> & pictures,
             int gap,
             const Colour & background,
             int columns = 0,
             int pageWidth = 0,
             int pageHeight = 0);

} // namespace rhombic

#endif
