#include "rhombicPlaneRequest.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

namespace rhombic
{

PlaneRequest
ParsePlaneRequest(const std::string & text)
{
  const auto equals = text.find('=');
  PlaneRequest request;
  request.plane = SlicePlaneFromName(text.substr(0, equals));
  request.place = equals == std::string::npos ? "" : text.substr(equals + 1);
  if (equals != std::string::npos && request.place.empty())
  {
    throw Failure(FailureKind::Usage,
                  "The plane '" + text +
                    "' names no place; write axial=12.5 (mm in LPS), axial=#40 (a slice), or axial=liver.");
  }
  return request;
}

CutRequest
ParseCutRequest(const std::string & text)
{
  const auto sign = text.find_first_of("<>");
  if (sign == std::string::npos)
  {
    const PlaneRequest plane = ParsePlaneRequest(text);
    return { plane, plane.plane != SlicePlane::Coronal };
  }
  const std::string axis = LowerCase(text.substr(0, sign));
  const std::string place = text.substr(sign + 1);
  for (const SlicePlane plane : { SlicePlane::Sagittal, SlicePlane::Coronal, SlicePlane::Axial })
  {
    const char letter = plane == SlicePlane::Sagittal ? 'x' : plane == SlicePlane::Coronal ? 'y' : 'z';
    if ((axis == NameOf(plane) || axis == std::string(1, letter)) && ToNumber<double>(place))
    {
      return { { plane, place }, text[sign] == '>' };
    }
  }
  throw Failure(FailureKind::Usage,
                "The cut '" + text +
                  "' is not understood; write x>12, y<-30 or z>100 (mm in LPS) for what is "
                  "removed, or a plane, as coronal=liver.");
}

} // namespace rhombic
