#include "rhombicLabelChoice.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include "itkFCCLattice.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <set>
#include <sstream>

namespace rhombic
{
namespace
{

/** The values of the labels with this value, or a name that fits (see MatchesPattern()). A label that has exactly this
 * name counts alone. Throws Failure(Usage) when there are none. */
std::set<std::int32_t>
FindValues(const std::vector<LabelSummary> & labels, const std::string & nameOrValue)
{
  std::set<std::int32_t> exact;
  std::set<std::int32_t> fitting;
  std::vector<std::string> names;
  for (const LabelSummary & summary : labels)
  {
    const Label & label = summary.label;
    if (label.name == nameOrValue || std::to_string(label.value) == nameOrValue)
    {
      exact.insert(label.value);
    }
    if (MatchesPattern(nameOrValue, label.name))
    {
      fitting.insert(label.value);
    }
    names.push_back(label.name);
  }
  if (exact.empty() && fitting.empty())
  {
    throw Failure(FailureKind::Usage,
                  DescribeUnknown("label", nameOrValue, names, "see rhombic info for the label map's labels"));
  }
  return exact.empty() ? fitting : exact;
}

std::string
Percent(double ratio)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::fixed << std::setprecision(1) << 100.0 * ratio << " %";
  return text.str();
}

} // namespace

std::vector<LabelSummary>
ChooseLabels(const LabelMap & map, const std::vector<std::string> & wanted)
{
  std::set<std::int32_t> values;
  for (const std::string & nameOrValue : wanted)
  {
    values.merge(FindValues(map.labels, nameOrValue));
  }
  std::vector<LabelSummary> chosen;
  std::copy_if(map.labels.begin(), map.labels.end(), std::back_inserter(chosen), [&](const LabelSummary & summary) {
    return wanted.empty() ? summary.label.isVisible && summary.label.opacity > 0.0
                          : values.count(summary.label.value) != 0;
  });
  if (chosen.empty())
  {
    throw Failure(FailureKind::Empty,
                  map.labels.empty() ? "The label map holds nothing but background; check that it was exported whole."
                                     : "The label table hides all labels of the map; name those to show.");
  }
  return chosen;
}

LabelSurface
DescribeLabel(const LabelSummary & summary)
{
  LabelSurface described;
  described.value = summary.label.value;
  described.numberOfVoxels = summary.numberOfVoxels;
  described.voxelMillilitres = summary.millilitres;
  described.scene.name = summary.label.name;
  described.scene.label = summary.label.value;
  for (unsigned int channel = 0; channel < 3; ++channel)
  {
    described.scene.colour[channel] = summary.label.colour[channel] / 255.0;
  }
  described.scene.opacity = summary.label.opacity > 0.0 ? summary.label.opacity : 1.0;
  return described;
}

void
CheckLabelDensity(double density)
{
  if (!(density > 0.0) || !(density <= 64.0))
  {
    throw Failure(FailureKind::Usage,
                  "The density of labels' lattices must be above 0 and at most 64 sites per voxel, not " +
                    std::to_string(density) + "; the default is " + FormatFixed(itk::FCCLattice::DefaultDensity, 2) +
                    ".");
  }
}

void
NoteShortcomings(const LabelSurface & made, const Events & events)
{
  if (made.isTorn || made.surfacePieces < made.pieces)
  {
    events.Note(made.scene.name + ": " + Count(made.pieces, "piece") + " became " + std::to_string(made.surfacePieces) +
                "; parts of it are hardly wider than a voxel");
  }
  constexpr double notable = 0.01;
  if (std::abs(made.GetVolumeDifference()) > notable)
  {
    events.Note(made.scene.name + ": the surface's volume differs by " + Percent(made.GetVolumeDifference()) +
                " from that of its voxels");
  }
}

} // namespace rhombic
