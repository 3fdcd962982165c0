#include "rhombicGreyWindow.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr const char * SoftTissue = "soft-tissue";

/** Nothing for a name that is no preset. */
const GreyWindow *
FindPreset(const std::string & name)
{
  const auto found = WindowPresets().find(LowerCase(name));
  return found == WindowPresets().end() ? nullptr : &found->second;
}

double
Percentile(std::vector<double> & values, double share)
{
  const auto rank = std::llround(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

} // namespace

const std::map<std::string, GreyWindow> &
WindowPresets()
{
  static const std::map<std::string, GreyWindow> presets{
    { "abdomen", { 350, 50 } },     { "bone", { 2000, 300 } },          { "brain", { 80, 40 } },
    { "emphysema", { 500, -850 } }, { "larynx", { 180, 80 } },          { "liver", { 150, 30 } },
    { "lung", { 1600, -600 } },     { "lung-hard", { 1000, -600 } },    { "mediastinum", { 350, 25 } },
    { "pelvis", { 450, 50 } },      { "posterior-fossa", { 120, 40 } }, { "sinus", { 4000, 400 } },
    { SoftTissue, { 400, 40 } },    { "vessels", { 650, 160 } },        { "vessels-hard", { 240, 80 } },
  };
  return presets;
}

std::optional<GreyWindow>
ParseWindow(const std::string & text)
{
  if (LowerCase(text) == "auto")
  {
    return std::nullopt;
  }
  if (const GreyWindow * const preset = FindPreset(text))
  {
    return *preset;
  }
  const std::vector<std::string> parts = Split(text, "/");
  if (parts.size() == 2)
  {
    const auto width = ToNumber<double>(parts[0]);
    const auto centre = ToNumber<double>(parts[1]);
    if (width && centre && *width > 0.0 && std::isfinite(*width) && std::isfinite(*centre))
    {
      return GreyWindow{ *width, *centre };
    }
    throw Failure(FailureKind::Usage,
                  "'" + text + "' is no window; give its width, above 0, and its centre, such as 350/50.");
  }
  std::vector<std::string> names{ "auto" };
  for (const auto & [name, window] : WindowPresets())
  {
    names.push_back(name);
  }
  throw Failure(FailureKind::Usage,
                DescribeUnknown("window", text, names, "use width and centre, such as 350/50, or " + Enumerate(names)));
}

GreyWindow
WindowFromText(const std::string & text, const Scan & scan)
{
  const std::optional<GreyWindow> window = ParseWindow(text);
  return window ? *window : AutomaticWindow(scan);
}

GreyWindow
AutomaticWindow(const Scan & scan)
{
  std::vector<double> values = TakeScanValues(scan);
  const double lowest = values.empty() ? 0.0 : *std::min_element(values.begin(), values.end());
  if (IsInHounsfieldUnits(scan))
  {
    return *FindPreset(SoftTissue);
  }
  values.erase(std::remove(values.begin(), values.end(), lowest), values.end());
  if (values.empty()) // all are the same
  {
    return { 1.0, lowest };
  }
  const double black = Percentile(values, 0.01);
  const double white = std::max(Percentile(values, 0.99), black + 1e-6 * std::max(1.0, std::abs(black)));
  return { white - black, 0.5 * (black + white) };
}

} // namespace rhombic
