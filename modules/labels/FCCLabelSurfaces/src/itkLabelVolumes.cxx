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

/** The layers by which labels gain volumes to first order. */
std::vector<double>
SolveLayers(const LabelAreas & areas,
            const std::vector<double> & gains,
            const std::vector<bool> & haveLayers,
            const LabelVolumes::BoundType & bound)
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
      double layer = total > 0.0 && haveLayers[label] ? sum / total : 0.0;
      layer = bound ? bound(label, layer) : layer;
      change = std::max(change, std::abs(layer - layers[label]));
      largest = std::max(largest, std::abs(layer));
      layers[label] = layer;
    }
  }
  return layers;
}

} // namespace

LabelSizes::LabelSizes(const LabelWalls & walls, std::size_t labels)
  : m_Origin(FindOrigin(walls))
  , m_Shares(walls.GetNumberOfTriangles())
  , m_Volumes(labels)
{
  this->Measure(walls, m_Shares.size(), [](std::size_t n) { return n; });
}

void
LabelSizes::Update(const LabelWalls & walls, const BulkVector<std::uint32_t> & triangles)
{
  this->Measure(walls, triangles.size(), [&triangles](std::size_t n) { return triangles[n]; });
}

template <typename TIdOf>
void
LabelSizes::Measure(const LabelWalls & walls, std::size_t count, const TIdOf & idOf)
{
  auto last = m_Areas.end();
  SumInOrder(
    count,
    [&](std::size_t n) {
      const std::size_t id = idOf(n);
      return Share{ 0.5 * Length(AreaVector(CornersOf(walls, walls.GetTriangles()[id]))),
                    FindVolumeOfTriangle(walls, id, m_Origin) };
    },
    [&](std::size_t n, const Share & share) {
      const std::size_t id = idOf(n);
      const auto & [front, back] = walls.GetTriangleLabels()[id];
      if (last == m_Areas.end() || last->first[0] != front || last->first[1] != back)
      {
        last = m_Areas.try_emplace({ front, back }, 0.0).first;
      }
      last->second += share.area - m_Shares[id].area;
      const double gained = share.volume - m_Shares[id].volume;
      m_Volumes[front] -= gained;
      m_Volumes[back] += gained;
      m_Shares[id] = share;
    });
}

LabelVolumes::LabelVolumes(const std::vector<double> & volumes, double tolerance)
  : m_Tolerance(tolerance)
  , m_Roots(volumes.size())
  , m_Layers(volumes.size())
{
  for (const double volume : volumes)
  {
    m_WantedRoots.push_back(std::cbrt(volume));
  }
}

const std::vector<double> &
LabelVolumes::FindLayers(const LabelSizes & sizes, const BoundType & bound)
{
  LabelAreas areas(m_Layers.size());
  for (const auto & [pair, area] : sizes.GetAreas())
  {
    areas[pair[0]].emplace_back(pair[1], area);
    areas[pair[1]].emplace_back(pair[0], area);
  }
  std::vector<double> gains(m_Layers.size());
  std::vector<bool> haveLayers(m_Layers.size());
  for (std::size_t label = 1; label < gains.size(); ++label)
  {
    double expected = 0.0; // gain by the last layers, to first order
    for (const auto & [other, area] : areas[label])
    {
      expected += area * (m_Layers[label] - m_Layers[other]);
    }
    const double root = std::cbrt(std::max(0.0, sizes.GetVolumes()[label]));
    const double slope = 3.0 * root * root;
    const double ratio = expected != 0.0 ? slope * (root - m_Roots[label]) / expected : 1.0;
    gains[label] = slope * (m_WantedRoots[label] - root) / std::clamp(ratio, 1.0 / SteepestSlope, SteepestSlope);
    m_Roots[label] = root;
    const double wanted = m_WantedRoots[label] * m_WantedRoots[label] * m_WantedRoots[label];
    haveLayers[label] = std::abs(sizes.GetVolumes()[label] - wanted) > m_Tolerance * wanted;
  }
  m_Layers = SolveLayers(areas, gains, haveLayers, bound);
  return m_Layers;
}

} // namespace itk
