#include "itkLabelVolumes.h"

#include "itkSumInOrder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace itk
{
namespace
{

constexpr double SteepestSlope = 3.0; // of volumes in layers, times the slope from the area
constexpr unsigned int MostSweeps = 1000;
constexpr double SmallestChange = 1e-5; // of the largest layer

/** The walls of each label: the other label, and the area in mm^2. */
using LabelAreas = std::vector<std::vector<std::pair<LabelWalls::LabelType, double>>>;

/** What walls enclose, and how large they are. */
struct LabelSizes
{
  LabelAreas areas;
  std::vector<double> volumes; ///< mm^3
};

LabelSizes
FindSizes(const LabelWalls & walls, std::size_t labels)
{
  struct Share // of a triangle
  {
    double area;
    double volume;
  };
  std::map<LabelWalls::LabelPairType, double> areas;
  auto last = areas.end();
  LabelSizes sizes{ LabelAreas(labels), std::vector<double>(labels) };
  SumInOrder(
    walls.GetNumberOfTriangles(),
    [&walls](std::size_t n) {
      return Share{ 0.5 * Length(AreaVector(CornersOf(walls, walls.GetTriangles()[n]))),
                    FindVolumeOfTriangle(walls, n) };
    },
    [&](std::size_t n, const Share & share) {
      const LabelWalls::LabelPairType & pair = walls.GetTriangleLabels()[n];
      if (last == areas.end() || last->first != pair)
      {
        last = areas.try_emplace(pair, 0.0).first;
      }
      last->second += share.area;
      sizes.volumes[pair[0]] -= share.volume;
      sizes.volumes[pair[1]] += share.volume;
    });
  for (const auto & [pair, area] : areas)
  {
    sizes.areas[pair[0]].emplace_back(pair[1], area);
    sizes.areas[pair[1]].emplace_back(pair[0], area);
  }
  return sizes;
}

/** The layers by which labels gain volumes to first order. */
std::vector<double>
SolveLayers(const LabelAreas & areas, const std::vector<double> & gains, const LabelVolumes::BoundType & bound)
{
  std::vector<double> layers(areas.size());
  double change = 1.0;
  double largest = 0.0;
  for (unsigned int sweep = 0; sweep < MostSweeps && change > SmallestChange * largest; ++sweep)
  {
    change = 0.0;
    for (std::size_t label = 1; label < areas.size(); ++label)
    {
      double sum = gains[label];
      double total = 0.0;
      for (const auto & [other, area] : areas[label])
      {
        sum += area * layers[other];
        total += area;
      }
      double layer = total > 0.0 ? sum / total : 0.0;
      layer = bound ? bound(label, layer) : layer;
      change = std::max(change, std::abs(layer - layers[label]));
      largest = std::max(largest, std::abs(layer));
      layers[label] = layer;
    }
  }
  return layers;
}

} // namespace

LabelVolumes::LabelVolumes(const std::vector<double> & volumes)
  : m_Roots(volumes.size())
  , m_Layers(volumes.size())
{
  for (const double volume : volumes)
  {
    m_WantedRoots.push_back(std::cbrt(volume));
  }
}

const std::vector<double> &
LabelVolumes::FindLayers(const LabelWalls & walls, const BoundType & bound)
{
  const auto [areas, volumes] = FindSizes(walls, m_Layers.size());
  std::vector<double> gains(m_Layers.size());
  for (std::size_t label = 1; label < gains.size(); ++label)
  {
    double expected = 0.0; // gain by the last layers, to first order
    for (const auto & [other, area] : areas[label])
    {
      expected += area * (m_Layers[label] - m_Layers[other]);
    }
    const double root = std::cbrt(std::max(0.0, volumes[label]));
    const double slope = 3.0 * root * root;
    const double ratio = expected != 0.0 ? slope * (root - m_Roots[label]) / expected : 1.0;
    gains[label] = slope * (m_WantedRoots[label] - root) / std::clamp(ratio, 1.0 / SteepestSlope, SteepestSlope);
    m_Roots[label] = root;
  }
  m_Layers = SolveLayers(areas, gains, bound);
  return m_Layers;
}

} // namespace itk
