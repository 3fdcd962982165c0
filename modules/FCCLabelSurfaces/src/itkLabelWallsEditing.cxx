#include "itkLabelWallsEditing.h"

#include "itkBoundedMoves.h"
#include "itkForEachBlock.h"
#include "detail/itkTriangleContact.h"
#include "itkTriangleTree.h"

#include <algorithm>
#include <cmath>

namespace itk
{
namespace
{

constexpr SizeValueType TestedBlock = 1024;
constexpr unsigned int VolumeCorrections = 16;
constexpr double ShareForVolumes = 0.1; // of the largest error of simplification

/** Moves walls along their normals until each label has its volume, or points are as far as they may go. A wall moves
 * by the sum of what its labels want: each a layer on all of its surface as large as what it lacks. Fixed points stay.
 */
void
RestoreVolumes(LabelWalls & walls,
               const std::vector<LabelWalls::Measures> & wanted,
               const TrianglesOfPoints & fans,
               const PointStrata & strata,
               BoundedMoves & moves)
{
  for (unsigned int n = 0; n < VolumeCorrections; ++n)
  {
    const auto measures = walls.ComputeMeasures();
    std::vector<double> layers(measures.size(), 0.0); // mm; outside takes what is left
    for (std::size_t label = 1; label < layers.size(); ++label)
    {
      const double lacking = wanted[label].volume - measures[label].volume;
      layers[label] = measures[label].area > 0.0 ? lacking / measures[label].area : 0.0;
    }
    moves.Step([&](SizeValueType point) {
      if (strata.strata[point] == Stratum::Fixed)
      {
        return walls.GetPoints()[point];
      }
      PositionType way{};
      double area = 0.0;
      fans.VisitTriangles(point, [&](std::uint32_t id) {
        const PositionType normal = AreaVector(CornersOf(walls, walls.GetTriangles()[id]));
        const auto & [front, back] = walls.GetTriangleLabels()[id];
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          way[axis] += (layers[back] - layers[front]) * normal[axis];
        }
        area += Length(normal);
      });
      return BoundedMoves::Move(walls.GetPoints()[point], area > 0.0 ? 1.0 / area : 0.0, way);
    });
  }
}

/** The ids of the triangles that meet others elsewhere than at shared corners and sides, ascending. */
std::vector<std::uint32_t>
FindMeetingTriangles(const LabelWalls & walls)
{
  const auto & points = walls.GetPoints();
  const auto & triangles = walls.GetTriangles();
  const TriangleTree tree(walls);
  std::vector<std::uint8_t> meets(triangles.size(), 0);
  ForEachInBlocks(triangles.size(), TestedBlock, [&](SizeValueType id) {
    tree.VisitTriangles(TriangleTree::BoxOf(points, triangles[id]), [&](std::uint32_t other) {
      meets[id] =
        meets[id] || (other != id && FindContact(points, triangles[id], triangles[other]) != TriangleContact::Apart);
    });
  });
  std::vector<std::uint32_t> found;
  for (std::uint32_t id = 0; id < meets.size(); ++id)
  {
    if (meets[id])
    {
      found.push_back(id);
    }
  }
  return found;
}

/** Restores volumes, and puts points of triangles that then meet others back to their start. */
TriangleSurfaceSmoothingReport
FinishMoves(LabelWalls & walls, const std::vector<LabelWalls::Measures> & wanted, BoundedMoves & moves)
{
  const TrianglesOfPoints fans(walls);
  const PointStrata strata = FindStrata(walls, fans);
  RestoreVolumes(walls, wanted, fans, strata, moves);
  while (moves.PutBackToStart(FindMeetingTriangles(walls)))
  {}
  return moves.Finish(fans, strata);
}

} // namespace

TriangleSurfaceSmoothingReport
RelaxWalls(LabelWalls & walls, const TriangleSurfaceSmoothingSettings & settings, const std::vector<double> & volumes)
{
  auto wanted = walls.ComputeMeasures();
  for (std::size_t label = 1; label < std::min(wanted.size(), volumes.size()); ++label)
  {
    wanted[label].volume = volumes[label] > 0.0 ? volumes[label] : wanted[label].volume;
  }
  BoundedMoves moves(walls, settings.maximumMove);
  SmoothSurface(walls, settings);
  const TriangleSurfaceSmoothingReport report = FinishMoves(walls, wanted, moves);
  walls.Modified();
  return report;
}

TriangleSurfaceSimplificationReport
SimplifyWalls(LabelWalls & walls, const TriangleSurfaceSimplificationSettings & settings)
{
  const auto measures = walls.ComputeMeasures();
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
  TriangleSurfaceSimplificationSettings shared = settings;
  shared.maximumError *= 1.0 - ShareForVolumes;
  const auto report = SimplifySurface(walls, sheets, shared);
  labels.resize(sheets.size());
  std::transform(sheets.begin(), sheets.end(), labels.begin(), [&pairs](std::uint32_t sheet) { return pairs[sheet]; });
  if (std::isfinite(settings.maximumError))
  {
    BoundedMoves moves(walls, ShareForVolumes * settings.maximumError);
    FinishMoves(walls, measures, moves);
  }
  walls.Modified();
  return report;
}

} // namespace itk
