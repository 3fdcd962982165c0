#include "rhombicView.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <cmath>
#include <vector>

namespace rhombic
{
namespace
{

constexpr Vector3 Leftwards{ 1, 0, 0 };
constexpr Vector3 Rightwards{ -1, 0, 0 };
constexpr Vector3 Backwards{ 0, 1, 0 };
constexpr Vector3 Forwards{ 0, -1, 0 };
constexpr Vector3 Headwards{ 0, 0, 1 };
constexpr Vector3 Footwards{ 0, 0, -1 };

View
MakeView(const std::string & name, const Vector3 & look, const Vector3 & up)
{
  return { name, { look, up, Cross(look, up) } };
}

/** Sine of an angle in degrees, exact at multiples of 90. */
double
Sine(double degrees)
{
  const double sine = std::sin(degrees * std::acos(-1.0) / 180.0);
  return std::abs(sine) < 1e-15 ? 0.0 : sine;
}

std::string
NameOfAngle(double degrees)
{
  return FormatNumber(degrees == 0.0 ? 0.0 : degrees); // not -0
}

} // namespace

const std::array<View, 6> &
StandardViews()
{
  static const std::array<View, 6> views{
    MakeView("anterior", Backwards, Headwards), MakeView("posterior", Forwards, Headwards),
    MakeView("left", Rightwards, Headwards),    MakeView("right", Leftwards, Headwards),
    MakeView("superior", Footwards, Forwards),  MakeView("inferior", Headwards, Forwards)
  };
  return views;
}

View
ObliqueView(double azimuth, double elevation)
{
  if (!(std::abs(azimuth) <= 360.0 && std::abs(elevation) <= 90.0))
  {
    throw Failure(FailureKind::Usage,
                  "A view's azimuth must be from -360 to 360 degrees and its elevation from -90 to 90, not " +
                    NameOfAngle(azimuth) + " and " + NameOfAngle(elevation) + ".");
  }
  const double sinA = Sine(azimuth);
  const double cosA = Sine(azimuth + 90.0);
  const double sinE = Sine(elevation);
  const double cosE = Sine(elevation + 90.0);
  return MakeView("az" + NameOfAngle(azimuth) + "el" + NameOfAngle(elevation),
                  { -cosE * sinA, cosE * cosA, -sinE },
                  { -sinE * sinA, sinE * cosA, cosE });
}

View
ViewFromText(const std::string & text)
{
  const std::vector<std::string> parts = Split(text, ",");
  const auto azimuth = ToNumber<double>(parts.front());
  const auto elevation = ToNumber<double>(parts.back());
  if (parts.size() == 2 && azimuth && elevation)
  {
    return ObliqueView(*azimuth, *elevation);
  }
  const std::string lowerCase = LowerCase(text);
  const std::string begin = lowerCase == "h" ? "superior" : lowerCase == "f" ? "inferior" : lowerCase;
  std::vector<std::string> names;
  for (const View & view : StandardViews())
  {
    if (!begin.empty() && view.name.rfind(begin, 0) == 0)
    {
      return view;
    }
    names.push_back(view.name);
  }
  throw Failure(FailureKind::Usage,
                DescribeUnknown("view", text, names, "use " + Enumerate(names) + ", or angles as 30,15"));
}

} // namespace rhombic
