#include "itkLabelWallsEditing.h"

#include <algorithm>

namespace itk
{

TriangleSurfaceSimplificationReport
SimplifyWalls(LabelWalls & walls, const TriangleSurfaceSimplificationSettings & settings)
{
  auto & labels = walls.GetTriangleLabels();
  std::vector<LabelWalls::LabelPairType> pairs(labels.begin(), labels.end());
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<std::uint32_t> sheets;
  sheets.reserve(labels.size());
  for (const LabelWalls::LabelPairType & pair : labels)
  {
    sheets.push_back(static_cast<std::uint32_t>(std::lower_bound(pairs.begin(), pairs.end(), pair) - pairs.begin()));
  }
  const auto report = SimplifySurface(walls, sheets, settings);
  labels.resize(sheets.size());
  std::transform(sheets.begin(), sheets.end(), labels.begin(), [&pairs](std::uint32_t sheet) { return pairs[sheet]; });
  return report;
}

} // namespace itk
