#ifndef rhombicImageAxes_h
#define rhombicImageAxes_h

#include "itkImageBase.h"

#include <cmath>

namespace rhombic
{

/** The axis of the image that is nearest to an axis of the patient: 0 leads to the left, 1 to the back, 2 to the head;
 * another one than \a except. */
inline unsigned int
NearestAxis(const itk::ImageBase<3>::DirectionType & direction, unsigned int patientAxis, unsigned int except = 3)
{
  unsigned int found = except == 0 ? 1 : 0;
  for (unsigned int axis = found + 1; axis < 3; ++axis)
  {
    if (axis != except && std::abs(direction[patientAxis][axis]) > std::abs(direction[patientAxis][found]))
    {
      found = axis;
    }
  }
  return found;
}

} // namespace rhombic

#endif
