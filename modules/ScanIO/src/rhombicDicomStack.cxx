#include "rhombicDicomStack.h"

#include "rhombicFailure.h"

#include "itkMath.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace rhombic
{
namespace
{

using Slices = std::vector<DicomSlice>;
using Vector = itk::Vector<double, 3>;

[[noreturn]] void
Refuse(const Slices & slices, const std::string & why, const std::string & advice)
{
  throw Failure(FailureKind::Geometry,
                "The slices in " + slices.front().path.parent_path().string() + " make no regular volume: " + why +
                  "; " + advice + ".");
}

std::string
NameOf(const DicomSlice & slice)
{
  return slice.path.filename().string();
}

std::string
Rounded(double number)
{
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", number);
  std::replace(text, text + sizeof(text), ',', '.');
  return text;
}

void
RequirePlanes(const Slices & slices)
{
  for (const DicomSlice & slice : slices)
  {
    if (!slice.plane)
    {
      throw Failure(FailureKind::Geometry,
                    "Cannot place " + slice.path.string() + " in the patient: " + slice.planeProblem +
                      "; export the series again from its source.");
    }
  }
  if (slices.size() < 2)
  {
    throw Failure(FailureKind::Geometry,
                  "There is only one slice, " + slices.front().path.string() +
                    ", in the series, and one slice is no volume; give the folder of the whole series.");
  }
}

/** The distance of each slice along the normal, which is ascending. */
std::vector<double>
SortAlongNormal(Slices & slices)
{
  Vector normal = itk::CrossProduct(slices.front().plane->columnStep, slices.front().plane->rowStep);
  normal.Normalize();
  const auto distance = [&normal](const DicomSlice & slice) {
    return slice.plane->position.GetVectorFromOrigin() * normal;
  };
  std::sort(slices.begin(), slices.end(), [&distance](const DicomSlice & first, const DicomSlice & second) {
    const double difference = distance(first) - distance(second);
    return difference < 0 || (difference == 0 && first.path < second.path);
  });
  std::vector<double> distances;
  std::transform(slices.begin(), slices.end(), std::back_inserter(distances), distance);
  return distances;
}

void
RequireUniquePositions(const Slices & slices, const std::vector<double> & steps)
{
  const double largest = *std::max_element(steps.begin(), steps.end());
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    if (steps[i] <= 0.01 * largest)
    {
      Refuse(slices,
             NameOf(slices[i]) + " and " + NameOf(slices[i + 1]) + " are at the same place",
             "put one set of slices into a folder of its own");
    }
  }
}

void
RequireNoTilt(const Slices & slices, double normalExtent)
{
  const Vector line = slices.back().plane->position - slices.front().plane->position;
  const double angle = std::acos(std::min(1.0, normalExtent / line.GetNorm()));
  constexpr double tolerance = 1e-3;
  if (angle > tolerance)
  {
    Refuse(slices,
           "they are sheared by " + Rounded(angle * 180 / itk::Math::pi) +
             " degrees against their normal, as a tilted CT gantry does",
           "this version does not straighten them, so resample the series first");
  }
}

double
ToleranceFor(double step)
{
  const double tolerance = std::max(0.01, 1e-3 * step); // mm
  return std::min(tolerance, 0.1 * step);
}

void
RequireUniformSteps(const Slices & slices, const std::vector<double> & steps)
{
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < steps.size(); ++i)
  {
    if (std::abs(steps[i] - usual) > ToleranceFor(usual))
    {
      Refuse(slices,
             "from " + NameOf(slices[i]) + " to " + NameOf(slices[i + 1]) + " it is " + Rounded(steps[i]) +
               " mm, elsewhere " + Rounded(usual) + " mm",
             steps[i] > usual ? "look for missing slices" : "look for slices of another reconstruction");
    }
  }
}

void
RequireLine(const Slices & slices, const Vector & step)
{
  for (std::size_t i = 0; i < slices.size(); ++i)
  {
    const Vector expected = step * static_cast<double>(i);
    const Vector actual = slices[i].plane->position - slices.front().plane->position;
    const double distance = (actual - expected).GetNorm();
    if (distance > ToleranceFor(step.GetNorm()))
    {
      Refuse(slices,
             NameOf(slices[i]) + " lies " + Rounded(distance) + " mm off the regular line of slices",
             "export the series again from its source");
    }
  }
}

} // namespace

VolumeGeometry
StackSlices(std::vector<DicomSlice> & slices)
{
  RequirePlanes(slices);
  const std::vector<double> distances = SortAlongNormal(slices);
  std::vector<double> steps;
  for (std::size_t i = 1; i < distances.size(); ++i)
  {
    steps.push_back(distances[i] - distances[i - 1]);
  }
  RequireUniquePositions(slices, steps);
  RequireNoTilt(slices, distances.back() - distances.front());
  RequireUniformSteps(slices, steps);

  const SlicePlane & first = *slices.front().plane;
  const Vector sliceStep = (slices.back().plane->position - first.position) / static_cast<double>(steps.size());
  RequireLine(slices, sliceStep);
  const itk::Size<3> size{ { slices.front().columns, slices.front().rows, slices.size() } };
  const Vector axes[3] = { first.columnStep, first.rowStep, sliceStep };
  return MakeGeometry(size, first.position, axes);
}

} // namespace rhombic
