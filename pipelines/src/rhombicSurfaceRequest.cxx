#include "rhombicSurfaceRequest.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

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

/** The named colours of CSS (CSS Color Module Level 4, 6.1), each with the digits of its red, green and blue. */
constexpr char NamedColours[] =
  "aliceblue f0f8ff antiquewhite faebd7 aqua 00ffff aquamarine 7fffd4 azure f0ffff beige f5f5dc "
  "bisque ffe4c4 black 000000 blanchedalmond ffebcd blue 0000ff blueviolet 8a2be2 brown a52a2a "
  "burlywood deb887 cadetblue 5f9ea0 chartreuse 7fff00 chocolate d2691e coral ff7f50 cornflowerblue 6495ed "
  "cornsilk fff8dc crimson dc143c cyan 00ffff darkblue 00008b darkcyan 008b8b darkgoldenrod b8860b "
  "darkgray a9a9a9 darkgreen 006400 darkgrey a9a9a9 darkkhaki bdb76b darkmagenta 8b008b "
  "darkolivegreen 556b2f darkorange ff8c00 darkorchid 9932cc darkred 8b0000 darksalmon e9967a "
  "darkseagreen 8fbc8f darkslateblue 483d8b darkslategray 2f4f4f darkslategrey 2f4f4f darkturquoise 00ced1 "
  "darkviolet 9400d3 deeppink ff1493 deepskyblue 00bfff dimgray 696969 dimgrey 696969 dodgerblue 1e90ff "
  "firebrick b22222 floralwhite fffaf0 forestgreen 228b22 fuchsia ff00ff gainsboro dcdcdc "
  "ghostwhite f8f8ff gold ffd700 goldenrod daa520 gray 808080 green 008000 greenyellow adff2f grey 808080 "
  "honeydew f0fff0 hotpink ff69b4 indianred cd5c5c indigo 4b0082 ivory fffff0 khaki f0e68c lavender e6e6fa "
  "lavenderblush fff0f5 lawngreen 7cfc00 lemonchiffon fffacd lightblue add8e6 lightcoral f08080 "
  "lightcyan e0ffff lightgoldenrodyellow fafad2 lightgray d3d3d3 lightgreen 90ee90 lightgrey d3d3d3 "
  "lightpink ffb6c1 lightsalmon ffa07a lightseagreen 20b2aa lightskyblue 87cefa lightslategray 778899 "
  "lightslategrey 778899 lightsteelblue b0c4de lightyellow ffffe0 lime 00ff00 limegreen 32cd32 "
  "linen faf0e6 magenta ff00ff maroon 800000 mediumaquamarine 66cdaa mediumblue 0000cd mediumorchid ba55d3 "
  "mediumpurple 9370db mediumseagreen 3cb371 mediumslateblue 7b68ee mediumspringgreen 00fa9a "
  "mediumturquoise 48d1cc mediumvioletred c71585 midnightblue 191970 mintcream f5fffa mistyrose ffe4e1 "
  "moccasin ffe4b5 navajowhite ffdead navy 000080 oldlace fdf5e6 olive 808000 olivedrab 6b8e23 "
  "orange ffa500 orangered ff4500 orchid da70d6 palegoldenrod eee8aa palegreen 98fb98 paleturquoise afeeee "
  "palevioletred db7093 papayawhip ffefd5 peachpuff ffdab9 peru cd853f pink ffc0cb plum dda0dd "
  "powderblue b0e0e6 purple 800080 rebeccapurple 663399 red ff0000 rosybrown bc8f8f royalblue 4169e1 "
  "saddlebrown 8b4513 salmon fa8072 sandybrown f4a460 seagreen 2e8b57 seashell fff5ee sienna a0522d "
  "silver c0c0c0 skyblue 87ceeb slateblue 6a5acd slategray 708090 slategrey 708090 snow fffafa "
  "springgreen 00ff7f steelblue 4682b4 tan d2b48c teal 008080 thistle d8bfd8 tomato ff6347 "
  "turquoise 40e0d0 violet ee82ee wheat f5deb3 white ffffff whitesmoke f5f5f5 yellow ffff00 "
  "yellowgreen 9acd32";

std::map<std::string, std::string>
DigitsByName()
{
  std::map<std::string, std::string> digitsByName;
  std::istringstream words(NamedColours);
  for (std::string name, digits; words >> name >> digits;)
  {
    digitsByName.emplace(name, digits);
  }
  return digitsByName;
}

/** The six digits of a colour, of which #rgb has every other digit; nothing for other texts. */
std::optional<std::string>
DigitsOf(const std::string & text)
{
  static const std::map<std::string, std::string> known = DigitsByName();
  const auto named = known.find(LowerCase(text));
  if (named != known.end())
  {
    return named->second;
  }
  const std::string digits = text.substr(text.rfind('#', 0) == 0 ? 1 : text.size());
  if (digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
  {
    return std::nullopt;
  }
  if (digits.size() == 3)
  {
    return std::string{ digits[0], digits[0], digits[1], digits[1], digits[2], digits[2] };
  }
  return digits.size() == 6 ? std::optional(digits) : std::nullopt;
}

} // namespace

Colour
ParseColour(const std::string & text)
{
  const auto digits = DigitsOf(text);
  if (!digits)
  {
    std::vector<std::string> names;
    for (const auto & named : DigitsByName())
    {
      names.push_back(named.first);
    }
    throw Failure(
      FailureKind::Usage,
      DescribeUnknown(
        "colour", text, names, "write it as #rrggbb, #rgb or by a name of CSS, for example #f1d691 or white"));
  }
  unsigned int value = 0;
  std::from_chars(digits->data(), digits->data() + digits->size(), value, 16);
  const auto component = [value](unsigned int shift) { return static_cast<double>(value >> shift & 0xff) / 255.0; };
  return { component(16), component(8), component(0) };
}

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
    request.hasOwnOpacity = true;
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
