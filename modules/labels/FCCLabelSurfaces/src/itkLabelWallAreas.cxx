#include "itkLabelWallAreas.h"

#include "detail/itkPositionArithmetic.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace itk
{

LabelWallAreas::LabelWallAreas(const LabelWalls & walls)
{
  std::map<LabelWalls::LabelPairType, double> areas;
  auto last = areas.end();
  for (std::size_t n = 0; n < walls.GetNumberOfTriangles(); ++n)
  {
    const LabelWalls::LabelPairType & labels = walls.GetTriangleLabels()[n];
    if (last == areas.end() || last->first != labels)
    {
      last = areas.try_emplace(labels, 0.0).first;
    }
    last->second += 0.5 * Length(AreaVector(CornersOf(walls, walls.GetTriangles()[n])));
  }
  for (const auto & [labels, area] : areas)
  {
    m_Walls.resize(std::max<std::size_t>(m_Walls.size(), labels[1] + std::size_t{ 1 }));
    m_Walls[labels[0]].emplace_back(labels[1], area);
    m_Walls[labels[1]].emplace_back(labels[0], area);
  }
}

std::vector<double>
LabelWallAreas::FindGains(std::vector<double> layers) const
{
  layers.resize(m_Walls.size());
  std::vector<double> gains(m_Walls.size());
  for (std::size_t label = 0; label < m_Walls.size(); ++label)
  {
    for (const auto & [other, area] : m_Walls[label])
    {
      gains[label] += area * (layers[label] - layers[other]);
    }
  }
  return gains;
}

std::vector<double>
LabelWallAreas::FindLayers(std::vector<double> gains, const BoundType & bound) const
{
  constexpr unsigned int mostSweeps = 1000;
  constexpr double smallestChange = 1e-5; // of the largest layer
  gains.resize(m_Walls.size());
  std::vector<double> layers(m_Walls.size());
  double change = 1.0;
  double largest = 0.0;
  for (unsigned int sweep = 0; sweep < mostSweeps && change > smallestChange * largest; ++sweep)
  {
    change = 0.0;
    for (std::size_t label = 1; label < m_Walls.size(); ++label)
    {
      double sum = gains[label];
      double total = 0.0;
      for (const auto & [other, area] : m_Walls[label])
      {
        sum += area * layers[other];
        total += area;
      }
      const double layer = total > 0.0 ? bound(label, sum / total) : 0.0;
      change = std::max(change, std::abs(layer - layers[label]));
      largest = std::max(largest, std::abs(layer));
      layers[label] = layer;
    }
  }
  return layers;
}

} // namespace itk
