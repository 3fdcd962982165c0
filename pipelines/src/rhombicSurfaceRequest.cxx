#include "rhombicSurfaceRequest.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <array>
#include <cmath>
#include <map>

namespace rhombic
{
namespace
{

// Colours of bone, skin, vessels and organs in 3D Slicer's generic anatomy table.
constexpr std::array<Colour, 6> palette{ { { 0.945, 0.839, 0.569 },
                                           { 0.694, 0.478, 0.396 },
                                           { 0.847, 0.396, 0.310 },
                                           { 0.502, 0.682, 0.502 },
                                           { 0.000, 0.592, 0.808 },
                                           { 0.902, 0.863, 0.275 } } };

/** A finite number. */
std::optional<double>
ParseNumber(const std::string & text)
{
  const auto number = ToNumber<double>(text);
  return number && std::isfinite(*number) ? number : std::nullopt;
}

} // namespace

bool
ParseThreshold(const std::string & text, SurfaceRequest & request)
{
  const bool isBelow = !text.empty() && text[0] == '<';
  const std::string number = isBelow ? text.substr(1) : text;
  request.insideIsBelow = isBelow;
  request.isovalue = ParseNumber(number);
  static const std::map<std::string, double Intensities::*> thresholds{ { "otsu", &Intensities::otsu },
                                                                        { "otsu-low", &Intensities::lowOtsu },
                                                                        { "otsu-lowest", &Intensities::lowestOtsu },
                                                                        { "otsu-high", &Intensities::highOtsu } };
  const auto found = thresholds.find(number);
  request.otsu = found != thresholds.end() ? found->second : &Intensities::otsu;
  return request.isovalue.has_value() || found != thresholds.end();
}

std::optional<double>
ParseOpacity(const std::string & text)
{
  const auto opacity = ParseNumber(text);
  return opacity && *opacity > 0.0 && *opacity <= 1.0 ? opacity : std::nullopt;
}

SurfaceRequest
ParseSurfaceRequest(const std::string & text, std::size_t number)
{
  const auto refuse = [&text](const std::string & why) -> Failure {
    return Failure(FailureKind::Usage,
                   "The surface '" + text + "' " + why +
                     "; write name=threshold[,colour[,opacity]], for example bone=250.5,#f1d691,1.");
  };
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
  {
    throw refuse("has no name or no threshold");
  }
  const auto fields = Split(text.substr(equals + 1), ",");
  SurfaceRequest request;
  request.name = text.substr(0, equals);
  request.colour = palette[number % palette.size()];

  if (!ParseThreshold(fields[0], request))
  {
    throw refuse("has a threshold that is no number");
  }
  if (fields.size() > 1 && !fields[1].empty())
  {
    request.colour = ParseColour(fields[1]);
  }
  if (fields.size() > 2)
  {
    const auto opacity = ParseOpacity(fields[2]);
    if (!opacity)
    {
      throw refuse("has an opacity that is not above 0 and at most 1");
    }
    request.opacity = *opacity;
  }
  if (fields.size() > 3)
  {
    throw refuse("has too many parts");
  }
  return request;
}

std::vector<SurfaceRequest>
ResolveIsovalues(std::vector<SurfaceRequest> requests, const Intensities & intensities)
{
  for (SurfaceRequest & request : requests)
  {
    if (!request.isovalue)
    {
      request.isovalue = intensities.*request.otsu;
    }
    // At the lowest value or below everything is inside, above the highest nothing: in both cases there is no surface.
    const double isovalue = *request.isovalue;
    if (isovalue > intensities.lowest && isovalue <= intensities.highest)
    {
      continue;
    }
    throw Failure(FailureKind::Empty,
                  intensities.lowest == intensities.highest
                    ? "All values of the scan are the same; check that it was exported completely."
                    : "The threshold " + FormatNumber(isovalue) + " of " + request.name +
                        " is outside the scan's values, which run from " + FormatNumber(intensities.lowest) + " to " +
                        FormatNumber(intensities.highest) + "; choose one in between.");
  }
  return requests;
}

} // namespace rhombic
