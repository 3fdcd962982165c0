#ifndef itkExampleLabelWalls_h
#define itkExampleLabelWalls_h

#include "itkFCCLabelSurfaceFilter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace itk::example
{

using Filter = itk::FCCLabelSurfaceFilter;
using LabelImage = Filter::InputImageType;
using Walls = itk::LabelWalls;

template <typename TLabelOf>
inline LabelImage::Pointer
MakeLabels(const LabelImage::RegionType & region, const TLabelOf & labelOf)
{
  const auto image = LabelImage::New();
  image->SetRegions(region);
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<LabelImage> it(image, region); !it.IsAtEnd(); ++it)
  {
    it.Set(labelOf(it.GetIndex()));
  }
  return image;
}

inline LabelImage::RegionType
Region(itk::IndexValueType first, itk::SizeValueType x, itk::SizeValueType y, itk::SizeValueType z)
{
  return { { { first, first + 1, 2 * first } }, { { x, y, z } } };
}

inline LabelImage::Pointer
MakeNoise(const LabelImage::RegionType & region, unsigned int seed, int labels)
{
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> label(0, labels - 1);
  return MakeLabels(region, [&](const auto &) { return static_cast<std::uint16_t>(label(random)); });
}

/** Voronoi cells of random points, some of them outside. */
inline LabelImage::Pointer
MakeBlobs(const LabelImage::RegionType & region, unsigned int seed, int labels)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<std::array<double, 3>> centres(static_cast<std::size_t>(labels));
  for (auto & centre : centres)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double length = static_cast<double>(region.GetSize(axis)) * (axis == 0 ? 2.0 : 1.0);
      const double first = static_cast<double>(region.GetIndex(axis)) * (axis == 0 ? 2.0 : 1.0);
      centre[axis] = first + share(random) * length;
    }
  }
  return MakeLabels(region, [&](const itk::Index<3> & index) {
    const auto site = itk::FCCLattice::SiteOf(index);
    double best = 1e9;
    std::uint16_t label = 0;
    for (std::size_t n = 0; n < centres.size(); ++n)
    {
      double distance = 0.0;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        distance += std::pow(static_cast<double>(site[axis]) - centres[n][axis], 2.0);
      }
      if (distance < best)
      {
        best = distance;
        label = static_cast<std::uint16_t>(n);
      }
    }
    return label;
  });
}

inline Walls::Pointer
MakeWalls(const LabelImage * labels, const itk::FCCLabelWeights * weights = nullptr, unsigned int threads = 0)
{
  const auto filter = Filter::New();
  filter->SetInput(labels);
  filter->SetWeights(weights);
  if (threads > 0)
  {
    filter->SetNumberOfWorkUnits(threads);
  }
  filter->Update();
  Walls::Pointer walls = filter->GetOutput();
  walls->DisconnectPipeline();
  return walls;
}

/** What every mesh of walls promises. */
inline void
ExpectSoundWalls(const Walls & walls, const LabelImage & labels)
{
  std::set<std::uint16_t> present;
  for (itk::ImageRegionConstIteratorWithIndex<LabelImage> it(&labels, labels.GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    present.insert(it.Get());
  }
  present.erase(0);
  const auto found = walls.FindLabels();
  EXPECT_EQ(std::set<std::uint16_t>(found.begin(), found.end()), present);
  for (const std::uint16_t label : found)
  {
    const auto surface = walls.ExtractLabel(label);
    const auto topology = itk::ComputeTriangleSurfaceTopology(*surface);
    ASSERT_TRUE(topology.IsWatertight()) << label << '\n' << topology;
    ASSERT_EQ(topology.repeatedPositions, 0u);
    ASSERT_GT(itk::ComputeTriangleSurfaceVolume(*surface), 0.0);
  }
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  std::map<Edge, std::pair<int, std::set<std::uint16_t>>> edges;
  ASSERT_EQ(walls.GetTriangleLabels().size(), walls.GetNumberOfTriangles());
  for (std::size_t n = 0; n < walls.GetNumberOfTriangles(); ++n)
  {
    const auto & pair = walls.GetTriangleLabels()[n];
    ASSERT_LT(pair[0], pair[1]);
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const auto [low, high] = std::minmax(walls.GetTriangles()[n][corner], walls.GetTriangles()[n][(corner + 1) % 3]);
      auto & edge = edges[{ low, high }];
      ++edge.first;
      edge.second.insert(pair.begin(), pair.end());
    }
  }
  for (const auto & [edge, use] : edges)
  {
    ASSERT_EQ(use.first, use.second.size() == 2 ? 2 : static_cast<int>(use.second.size()));
  }
}

} // namespace itk::example

#endif
