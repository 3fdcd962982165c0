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
  const bool isComparison = text.size() > 2 && (text[1] == '>' || text[1] == '<');
  if (!isComparison)
  {
    const PlaneRequest plane = ParsePlaneRequest(text);
    return { plane, plane.plane != SlicePlane::Coronal };
  }
  const std::string axis = LowerCase(text.substr(0, 1));
  const std::string place = text.substr(2);
  if (std::string("xyz").find(axis) == std::string::npos || !ToNumber<double>(place))
  {
    throw Failure(FailureKind::Usage,
                  "The cut '" + text +
                    "' is not understood; write x>12, y<-30 or z>100 (mm in LPS) for what is "
                    "removed, or a plane, as coronal=liver.");
  }
  const SlicePlane plane = axis == "x" ? SlicePlane::Sagittal : axis == "y" ? SlicePlane::Coronal : SlicePlane::Axial;
  return { { plane, place }, text[1] == '>' };
}

} // namespace rhombic
