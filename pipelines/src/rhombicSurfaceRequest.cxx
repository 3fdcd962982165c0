#include "rhombicSurfaceRequest.h"

#include "rhombicFailure.h"

#include <charconv>
#include <cmath>
#include <vector>

namespace rhombic
{
namespace
{

// Bone, skin, vessel, organ and more of the colours that 3D Slicer's generic anatomy table made customary.
constexpr std::array<Colour, 6> palette{ { { 0.945, 0.839, 0.569 },
                                           { 0.694, 0.478, 0.396 },
                                           { 0.847, 0.396, 0.310 },
                                           { 0.502, 0.682, 0.502 },
                                           { 0.000, 0.592, 0.808 },
                                           { 0.902, 0.863, 0.275 } } };

std::vector<std::string>
Split(const std::string & text, char separator)
{
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (auto end = text.find(separator); end != std::string::npos; end = text.find(separator, begin))
  {
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  parts.push_back(text.substr(begin));
  return parts;
}

std::optional<double>
ParseNumber(const std::string & text)
{
  double number = 0.0;
  const auto end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(number))
  {
    return std::nullopt;
  }
  return number;
}

} // namespace

bool
ParseThreshold(const std::string & text, SurfaceRequest & request)
{
  const bool isBelow = !text.empty() && text[0] == '<';
  const std::string number = isBelow ? text.substr(1) : text;
  request.side = isBelow ? SurfaceRequest::Side::Below : SurfaceRequest::Side::Above;
  request.isovalue = ParseNumber(number);
  return request.isovalue.has_value() || number == "otsu";
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
  const auto fields = Split(text.substr(equals + 1), ',');
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
    const auto opacity = ParseNumber(fields[2]);
    if (!opacity || !(*opacity > 0.0) || *opacity > 1.0)
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

} // namespace rhombic
