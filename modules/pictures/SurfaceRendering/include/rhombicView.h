#ifndef rhombicView_h
#define rhombicView_h

#include "rhombicProjection.h"

#include <array>
#include <string>

namespace rhombic
{

/** \file
 * From where the patient is seen. */

/** \class View
 * \brief A name and the axes of the picture. By default the anterior view. */
struct View
{
  std::string name = "anterior"; ///< fit for a file name
  ViewFrame frame{ { 0, 1, 0 }, { 0, 0, 1 }, { 1, 0, 0 } };
};

/** Anterior, posterior, left, right, superior and inferior: the side of the patient that is seen. The head is up in the
 * first four. In the superior and inferior views the front of the body is up; the inferior view has the usual
 * orientation of axial slices. */
const std::array<View, 6> &
StandardViews();

/** An oblique view. The viewer starts in front of the patient.
 * \param azimuth degrees, -360 to 360: positive turns the viewer towards the patient's left; 90 is the left view
 * \param elevation degrees, -90 to 90: positive lifts the viewer towards the head. At 90 the back of the body is up
 * when the azimuth is 0, its front when the azimuth is 180.
 *
 * The name of (30, -15) is "az30el-15". Throws Failure(Usage) for angles out of range. */
View
ObliqueView(double azimuth, double elevation);

/** The view of a text, in upper or lower case: a standard view's name or a beginning of it ("ant", "a"), its edge
 * letter as h or f for superior and inferior, or two angles as "30,15". Throws Failure(Usage), listing the names, for
 * another text. */
View
ViewFromText(const std::string & text);

} // namespace rhombic

#endif
