#include "rhombicNIfTIAffine.h"

#include "rhombicVolumeRefusal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

using Affine = std::array<itk::Vector<double, 3>, 4>; ///< the steps along three axes and the origin, in RAS

double
MillimetresPerUnit(const NIfTIHeader & header)
{
  constexpr int metre = 1, micrometre = 3;
  const int unit = header.units & 7;
  return unit == metre ? 1e3 : unit == micrometre ? 1e-3 : 1.0;
}

void
CheckPixdim(const NIfTIHeader & header, const fs::path & path)
{
  for (std::size_t axis = 1; axis <= 3; ++axis)
  {
    if (!std::isfinite(header.pixdim[axis]) || header.pixdim[axis] <= 0)
    {
      RefuseGeometry(path,
                     "its voxels have no proper size along axis " + std::to_string(axis - 1) + " (pixdim is " +
                       std::to_string(header.pixdim[axis]) + "); export it again from its source");
    }
  }
}

Affine
Sform(const NIfTIHeader & header)
{
  Affine affine;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int column = 0; column < 4; ++column)
    {
      affine[column][row] = header.sform[row][column];
    }
  }
  return affine;
}

/** The affine of the quaternion, as nifti1.h defines it. */
Affine
Qform(const NIfTIHeader & header, const fs::path & path)
{
  auto [b, c, d] = header.quaternion;
  const double squares = b * b + c * c + d * d;
  constexpr double tolerance = 1e-3;
  if (!std::isfinite(squares) || !std::isfinite(header.pixdim[0]) || squares > 1 + tolerance)
  {
    RefuseGeometry(path, "its qform holds a quaternion that is no rotation; export it again from its source");
  }
  const bool isHalfTurn = 1 - squares < 1e-7; // the tolerance of nifti1_io.c
  const double norm = isHalfTurn ? std::sqrt(squares) : 1.0;
  b /= norm;
  c /= norm;
  d /= norm;
  const double a = isHalfTurn ? 0.0 : std::sqrt(1 - squares);
  const double rotation[3][3] = {
    { a * a + b * b - c * c - d * d, 2 * b * c - 2 * a * d, 2 * b * d + 2 * a * c },
    { 2 * b * c + 2 * a * d, a * a + c * c - b * b - d * d, 2 * c * d - 2 * a * b },
    { 2 * b * d - 2 * a * c, 2 * c * d + 2 * a * b, a * a + d * d - c * c - b * b },
  };
  const double handedness = header.pixdim[0] < 0 ? -1 : 1;
  Affine affine;
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      affine[axis][row] = rotation[row][axis] * header.pixdim[axis + 1] * (axis == 2 ? handedness : 1);
    }
    affine[3][row] = header.qformOffset[row];
  }
  return affine;
}

/** An affine along the LPS axes, which ITK and most viewers use for files without an orientation. */
Affine
Unoriented(const NIfTIHeader & header)
{
  Affine affine{};
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    affine[axis][axis] = header.pixdim[axis + 1] * (axis == 2 ? 1 : -1);
  }
  return affine;
}

/** The largest distance between the positions of a corner of the volume by two affines. */
double
CornerDistance(const Affine & first, const Affine & second, const itk::Size<3> & size)
{
  double largest = 0;
  for (unsigned int corner = 0; corner < 8; ++corner)
  {
    itk::Vector<double, 3> difference = first[3] - second[3];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double index = (corner >> axis & 1) != 0 ? static_cast<double>(size[axis] - 1) : 0.0;
      difference += (first[axis] - second[axis]) * index;
    }
    largest = std::max(largest, difference.GetNorm());
  }
  return largest;
}

double
SmallestStep(const Affine & affine)
{
  return std::min({ affine[0].GetNorm(), affine[1].GetNorm(), affine[2].GetNorm() });
}

bool
HasSteps(const Affine & affine, const NIfTIHeader & header)
{
  constexpr double tolerance = 1e-3;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    if (std::abs(affine[axis].GetNorm() - header.pixdim[axis + 1]) > tolerance * header.pixdim[axis + 1])
    {
      return false;
    }
  }
  return true;
}

VolumeGeometry
ToLPSMillimetres(Affine affine, double millimetresPerUnit, const itk::Size<3> & size)
{
  for (auto & step : affine)
  {
    step *= millimetresPerUnit;
    step[0] = -step[0];
    step[1] = -step[1];
  }
  itk::Point<double, 3> origin;
  origin.Fill(0);
  return MakeGeometry(size, origin + affine[3], affine.data());
}

} // namespace

VolumeGeometry
PlaceNIfTIVolume(const NIfTIHeader & header,
                 const itk::Size<3> & size,
                 const fs::path & path,
                 ScanReadOptions::Policy onSheared,
                 Scan & scan)
{
  const bool isAnalyze =
    header.kind == NIfTIHeader::Kind::Analyze; // its header has other fields where NIfTI has the codes
  const bool hasSform = !isAnalyze && header.sformCode > 0;
  const bool hasQform = !isAnalyze && header.qformCode > 0;
  const double millimetresPerUnit = isAnalyze ? 1.0 : MillimetresPerUnit(header);
  CheckPixdim(header, path);

  AffineReport report;
  report.source = hasSform ? "sform" : hasQform ? "qform" : "none";
  const Affine affine = hasSform ? Sform(header) : hasQform ? Qform(header, path) : Unoriented(header);
  const VolumeGeometry geometry = ToLPSMillimetres(affine, millimetresPerUnit, size);
  CheckGeometry(geometry, path, hasSform || hasQform ? report.source : "pixdim", onSheared, scan.notes);

  if (!hasSform && !hasQform)
  {
    scan.isOriented = false;
    scan.notes.push_back(path.string() + " does not say how it lies in the patient; left and right are a guess.");
  }
  else if (hasSform && hasQform)
  {
    const double distance = CornerDistance(affine, Qform(header, path), size);
    if (!std::isfinite(distance))
    {
      RefuseGeometry(path, "its qform holds numbers that are not finite; export it again from its source");
    }
    report.disagreement = distance * millimetresPerUnit;
    constexpr double tolerance = 1e-2; // relative to a voxel: quaternions are rounded
    if (distance > tolerance * SmallestStep(affine))
    {
      scan.notes.push_back(path.string() + " gives two positions in the patient, up to " +
                           std::to_string(report.disagreement) + " mm apart; its sform was used, not its qform.");
    }
  }
  else if (hasSform && !HasSteps(affine, header))
  {
    scan.notes.push_back(path.string() +
                         " gives two sizes for its voxels; that of its sform was used, not that of pixdim.");
  }
  scan.affine = report;
  return geometry;
}

} // namespace rhombic
