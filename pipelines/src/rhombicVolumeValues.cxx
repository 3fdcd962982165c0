#include "rhombicVolumeValues.h"

#include "rhombicFailure.h"
#include "rhombicForEachBlock.h"
#include "rhombicScanValues.h"
#include "rhombicScanSource.h"
#include "rhombicStandardUptake.h"
#include "rhombicWording.h"

#include "itkLinearInterpolateImageFunction.h"
#include "itkTriangleSurfaceThickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rhombic
{
namespace
{

using Place = std::array<double, 3>;

/** The box around a volume's voxels, along the patient's axes. */
std::pair<Place, Place>
BoxOfVoxels(const itk::ImageBase<3> & grid)
{
  const auto & region = grid.GetLargestPossibleRegion();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::pair<Place, Place> box{ { infinity, infinity, infinity }, { -infinity, -infinity, -infinity } };
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    itk::ContinuousIndex<double, 3> index;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const bool isHigh = (corner >> axis & 1) != 0;
      index[axis] =
        static_cast<double>(region.GetIndex(axis)) - 0.5 + (isHigh ? static_cast<double>(region.GetSize(axis)) : 0.0);
    }
    itk::Point<double, 3> point;
    grid.TransformContinuousIndexToPhysicalPoint(index, point);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      box.first[axis] = std::min(box.first[axis], point[axis]);
      box.second[axis] = std::max(box.second[axis], point[axis]);
    }
  }
  return box;
}

/** Where a point's values are taken. */
struct InwardWay
{
  Place normal{};     ///< outwards
  float length = 0.0; ///< mm
};

/** The ways inwards of a surface's points: as long as the depth, but not out of the body again. */
itk::BulkVector<InwardWay>
FindWays(const itk::TriangleSurface & surface, double depth)
{
  const auto normals = ComputeTriangleSurfacePointNormals(surface);
  const itk::BulkVector<float> walls = ComputeTriangleSurfaceWalls(surface, itk::TriangleTree(surface));
  itk::BulkVector<InwardWay> ways(normals.size());
  for (std::size_t n = 0; n < ways.size(); ++n)
  {
    ways[n] = { normals[n],
                std::isnan(walls[n]) ? static_cast<float>(depth) : std::min(walls[n], static_cast<float>(depth)) };
  }
  return ways;
}

/** The mean or the highest of values. */
class ValueSummary
{
public:
  explicit ValueSummary(ColourBy::Summary summary)
    : m_IsMean(summary != ColourBy::Summary::Maximum)
  {}

  void
  Add(double value)
  {
    m_Value = m_IsMean ? m_Value + value : m_Count == 0 ? value : std::max(m_Value, value);
    ++m_Count;
  }

  float
  Get() const
  {
    return m_Count == 0 ? std::numeric_limits<float>::quiet_NaN()
                        : static_cast<float>(m_IsMean ? m_Value / static_cast<double>(m_Count) : m_Value);
  }

private:
  bool m_IsMean;
  std::size_t m_Count = 0;
  double m_Value = 0.0;
};

/** The values of a surface's points, as stored. */
template <typename TImage>
itk::BulkVector<float>
SampleSurface(const TImage & image, const ColourBy & by, const itk::TriangleSurface & surface)
{
  const auto interpolator = itk::LinearInterpolateImageFunction<TImage, double>::New();
  interpolator->SetInputImage(&image);
  const auto & spacing = image.GetSpacing();
  const double step = 0.5 * std::min({ spacing[0], spacing[1], spacing[2] });
  const bool goesInwards = by.summary != ColourBy::Summary::AtSurface;
  const itk::BulkVector<InwardWay> ways =
    goesInwards ? FindWays(surface, by.depth) : itk::BulkVector<InwardWay>(surface.GetNumberOfPoints());
  itk::BulkVector<float> values(ways.size());
  constexpr std::size_t blockSize = 1024;
  ForEachInBlocks(ways.size(), blockSize, [&](std::size_t n) {
    const auto & point = surface.GetPoints()[n];
    const auto steps = static_cast<std::size_t>(std::ceil(ways[n].length / step));
    ValueSummary summary(by.summary);
    for (std::size_t k = 0; k <= steps; ++k)
    {
      const double way = steps == 0 ? 0.0 : ways[n].length * static_cast<double>(k) / static_cast<double>(steps);
      itk::Point<double, 3> position;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        position[axis] = point[axis] - way * ways[n].normal[axis];
      }
      if (interpolator->IsInsideBuffer(position))
      {
        summary.Add(interpolator->Evaluate(position));
      }
    }
    values[n] = summary.Get();
  });
  return values;
}

/** The factor and the unit of a volume's values: SUV for a PET that tells all that it needs. */
std::pair<double, std::string>
FindUnit(const Scan & volume, const std::string & name, const Events & events)
{
  if (IsInHounsfieldUnits(volume))
  {
    return { 1.0, "HU" };
  }
  const std::string unit = ReadDicomExamination(volume).units;
  if (volume.modality != "PT")
  {
    return { 1.0, unit };
  }
  const StandardUptake uptake = FindStandardUptake(volume);
  if (uptake.factor)
  {
    return { *uptake.factor, "SUV" };
  }
  events.Note(name + ": no SUV, as " + uptake.reason + "; its values stay in " + (unit.empty() ? "their unit" : unit));
  return { 1.0, unit };
}

} // namespace

void
RequireSamePlace(const std::filesystem::path & file,
                 const Place & low,
                 const Place & high,
                 const std::vector<SceneSurface> & surfaces)
{
  double nearest = std::numeric_limits<double>::infinity(); // squared
  for (const SceneSurface & surface : surfaces)
  {
    const auto bounds = surface.surface->GetBounds();
    double squared = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      const double apart = std::max({ 0.0, low[axis] - bounds[2 * axis + 1], bounds[2 * axis] - high[axis] });
      squared += apart * apart;
    }
    nearest = std::min(nearest, squared);
  }
  if (nearest > 0.0)
  {
    throw Failure(FailureKind::Geometry,
                  file.filename().string() + " and the surfaces do not lie in one space: their boxes are " +
                    FormatNumber(std::sqrt(nearest), 4) +
                    " mm apart; check that both are of one patient and one scan.");
  }
}

ScanSource
SourceOfVolume(const ColourBy & by)
{
  ScanSource source;
  source.path = by.file;
  source.read.maximumMemory = by.maximumMemory;
  source.read.temporaryFolder = by.temporaryFolder;
  return source;
}

VolumeValues
SampleVolume(const ColourBy & by,
             const std::string & frameOfReference,
             const std::vector<SceneSurface> & surfaces,
             const Events & events)
{
  const Scan volume = ReadScan(SourceOfVolume(by), events);
  if (!volume.sliceOrigins.empty())
  {
    throw Failure(FailureKind::Usage,
                  by.file.string() + " has unevenly spaced slices, between which values are not computed; resample it "
                                     "first.");
  }
  const auto [low, high] = BoxOfVoxels(GeometryOf(volume.image));
  RequireSamePlace(by.file, low, high, surfaces);
  NoteFramesOfReference(frameOfReference, ReadDicomExamination(volume).frameOfReference, by.file, events);
  VolumeValues sampled;
  double factor = 1.0;
  std::tie(factor, sampled.unit) = FindUnit(volume, by.file.filename().string(), events);
  for (const SceneSurface & surface : surfaces)
  {
    sampled.values.push_back(
      std::visit([&](const auto & image) { return SampleSurface(*image, by, *surface.surface); }, volume.image));
    for (float & value : sampled.values.back())
    {
      value = static_cast<float>(factor * value);
    }
  }
  return sampled;
}

} // namespace rhombic
