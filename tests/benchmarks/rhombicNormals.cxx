#include "rhombicExtractSurface.h"
#include "rhombicFieldSampling.h"
#include "rhombicShapeFields.h"
#include "rhombicSurfaceErrors.h"
#include "rhombicTextTable.h"

#include "itkCartesianToFCCImageFilter.h"
#include "itkTriangleSurfaceForRendering.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <random>

namespace rhombic
{
namespace
{

using VolumeType = itk::Image<float, 3>;

constexpr Vector3 Spacing{ 3.2, 3.2, 1.5 }; // mm

/** \class Ellipsoid
 * \brief An ellipsoid turned at random about the world's origin. */
struct Ellipsoid
{
  Vector3 centre;
  Vector3 halfAxes;
  std::array<Vector3, 3> axes; ///< unit vectors

  Vector3
  ToAxes(const Vector3 & point) const
  {
    Vector3 local;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      local[axis] = 0.0;
      for (unsigned int i = 0; i < 3; ++i)
      {
        local[axis] += axes[axis][i] * (point[i] - centre[i]);
      }
    }
    return local;
  }

  bool
  Contains(const Vector3 & point) const
  {
    const Vector3 local = this->ToAxes(point);
    return std::hypot(local[0] / halfAxes[0], local[1] / halfAxes[1], local[2] / halfAxes[2]) <= 1.0;
  }

  /** The outward unit normal at the surface's point that is nearest to a point. That is a_i^2 p_i / (a_i^2 + t), with
   * the largest t for which it is on the surface. */
  Vector3
  NormalAt(const Vector3 & point) const
  {
    const Vector3 local = this->ToAxes(point);
    double t = 0.0;
    for (int step = 0; step < 20; ++step)
    {
      double value = -1.0;
      double slope = 0.0;
      for (unsigned int i = 0; i < 3; ++i)
      {
        const double sum = halfAxes[i] * halfAxes[i] + t;
        const double ratio = halfAxes[i] * local[i] / sum;
        value += ratio * ratio;
        slope -= 2.0 * ratio * ratio / sum;
      }
      t -= value / slope;
    }
    Vector3 normal{};
    for (unsigned int i = 0; i < 3; ++i)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        normal[axis] += local[i] / (halfAxes[i] * halfAxes[i] + t) * axes[i][axis];
      }
    }
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    return { normal[0] / length, normal[1] / length, normal[2] / length };
  }
};

Ellipsoid
MakeEllipsoid(const Vector3 & halfAxes, std::mt19937 & random)
{
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(-0.5, 0.5);
  double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  w /= length;
  x /= length;
  y /= length;
  z /= length;
  Ellipsoid ellipsoid;
  ellipsoid.halfAxes = halfAxes;
  ellipsoid.axes = { { { 1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y) },
                       { 2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x) },
                       { 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y) } } };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    ellipsoid.centre[axis] = uniform(random) * Spacing[axis];
  }
  return ellipsoid;
}

/** The share of \a samples^3 points in each voxel that are inside; 1 for the voxels' centres. */
VolumeType::Pointer
Scan(const Ellipsoid & ellipsoid, int samples)
{
  const double reach = *std::max_element(ellipsoid.halfAxes.begin(), ellipsoid.halfAxes.end());
  const auto volume = VolumeType::New();
  VolumeType::SizeType size;
  VolumeType::PointType origin;
  VolumeType::SpacingType spacing;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const auto half = static_cast<itk::SizeValueType>(std::ceil(reach / Spacing[axis])) + 3;
    size[axis] = 2 * half + 1;
    spacing[axis] = Spacing[axis];
    origin[axis] = -static_cast<double>(half) * Spacing[axis];
  }
  volume->SetRegions(size);
  volume->SetSpacing(spacing);
  volume->SetOrigin(origin);
  volume->Allocate();
  for (itk::ImageRegionIteratorWithIndex<VolumeType> it(volume, volume->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    VolumeType::PointType centre;
    volume->TransformIndexToPhysicalPoint(it.GetIndex(), centre);
    int inside = 0;
    for (int n = 0; n < samples * samples * samples; ++n)
    {
      const std::array<int, 3> at{ n % samples, n / samples % samples, n / samples / samples };
      Vector3 point;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        point[axis] = centre[axis] + ((at[axis] + 0.5) / samples - 0.5) * Spacing[axis];
      }
      inside += ellipsoid.Contains(point) ? 1 : 0;
    }
    it.Set(static_cast<float>(1000.0 * inside / (samples * samples * samples)));
  }
  return volume;
}

/** \class Angle
 * \brief An angle between two normals in degrees, and the area it stands for. */
struct Angle
{
  double degrees;
  double area;
};

/** At the triangles' centres, where shading normals are the means of those of the corners. */
void
AddAngles(const itk::TriangleSurface & surface, const Ellipsoid & truth, std::vector<Angle> & angles)
{
  for (const auto & triangle : surface.GetTriangles())
  {
    Vector3 centre{};
    Vector3 shading{};
    for (const auto point : triangle)
    {
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        centre[axis] += surface.GetPoints()[point][axis] / 3.0;
        shading[axis] += surface.GetNormals()[point][axis];
      }
    }
    const auto edge = [&](unsigned int corner, unsigned int axis) {
      return double{ surface.GetPoints()[triangle[corner]][axis] } - surface.GetPoints()[triangle[0]][axis];
    };
    const double area = 0.5 * std::hypot(edge(1, 1) * edge(2, 2) - edge(1, 2) * edge(2, 1),
                                         edge(1, 2) * edge(2, 0) - edge(1, 0) * edge(2, 2),
                                         edge(1, 0) * edge(2, 1) - edge(1, 1) * edge(2, 0));
    const Vector3 normal = truth.NormalAt(centre);
    const double cosine = (shading[0] * normal[0] + shading[1] * normal[1] + shading[2] * normal[2]) /
                          std::hypot(shading[0], shading[1], shading[2]);
    angles.push_back({ std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::acos(-1.0), area });
  }
}

/** "mean / 95 %" of the angles, weighted by area. */
std::string
Summarise(std::vector<Angle> angles)
{
  std::sort(angles.begin(), angles.end(), [](const Angle & a, const Angle & b) { return a.degrees < b.degrees; });
  double sum = 0.0;
  double area = 0.0;
  for (const Angle & angle : angles)
  {
    sum += angle.degrees * angle.area;
    area += angle.area;
  }
  double below = 0.0;
  std::size_t n = 0;
  while (n + 1 < angles.size() && (below += angles[n].area) < 0.95 * area)
  {
    ++n;
  }
  return Fixed(sum / area, 2) + " / " + Fixed(angles[n].degrees, 1);
}

itk::FCCImage<float>::ConstPointer
ToLattice(const VolumeType * volume)
{
  const auto resampler = itk::CartesianToFCCImageFilter<VolumeType>::New();
  resampler->SetInput(volume);
  resampler->Update();
  return resampler->GetOutput();
}

void
PrintCoarseScans()
{
  for (const int samples : { 1, 8 })
  {
    TextTable table({ "mode", "gradients", "smoothed" });
    for (const ExtractionMode mode : ExtractionModes)
    {
      std::mt19937 random(1);
      std::vector<Angle> before;
      std::vector<Angle> after;
      for (int seed = 0; seed < 2; ++seed)
      {
        for (const Vector3 & halfAxes :
             { Vector3{ 46, 30, 33 }, Vector3{ 18, 15, 36 }, Vector3{ 12, 19, 23 } }) // liver, kidney, spleen
        {
          const Ellipsoid organ = MakeEllipsoid(halfAxes, random);
          const auto lattice = ToLattice(Scan(organ, samples));
          const auto surface = ExtractSurface(lattice.GetPointer(), 500.5, mode, true, true);
          AddAngles(*surface, organ, before);
          itk::SmoothTriangleSurfaceNormals(*surface);
          AddAngles(*surface, organ, after);
        }
      }
      table.Add({ NameOf(mode), Summarise(before), Summarise(after) });
    }
    std::cout << (samples == 1 ? "\nsamples of a step at voxels' centres\n" : "\naverages of a step over voxels\n");
    table.Print(std::cout);
  }
}

void
PrintFineScans()
{
  constexpr unsigned int size = 40;
  TextTable table({ "field", "mode", "gradients", "smoothed" });
  const ReferenceField sphere = MakeSphereField({ 19.3, 19.6, 19.8 }, 13.0);
  const ReferenceField torus = MakeTorusField({ 19.3, 19.6, 19.8 }, { 0.3, -0.2, 0.4 }, 10.8, 5.0);
  const ReferenceField quarter = MakeBandLimitedField(0.25, 1);
  const ReferenceField half = MakeBandLimitedField(0.5, 1);
  const ReferenceField threeQuarters = MakeBandLimitedField(0.75, 1);
  const std::pair<const char *, const ReferenceField *> fields[] = { { "sphere", &sphere },
                                                                     { "torus", &torus },
                                                                     { "waves 0.25", &quarter },
                                                                     { "waves 0.50", &half },
                                                                     { "waves 0.75", &threeQuarters } };
  for (const auto & [name, field] : fields)
  {
    const auto lattice = ToLattice(SampleOnGrid<float>(*field, size, 1.0));
    for (const ExtractionMode mode : ExtractionModes)
    {
      const auto surface = ExtractSurface(lattice.GetPointer(), 0.0, mode, true, true);
      const auto angle = [&] {
        return ComputeSurfaceErrors(*surface, NearestOnField(*field, 1.0), { { 3, 3, 3 }, { 36, 36, 36 }, 1.0 })
          .vertexNormalError;
      };
      const double before = angle();
      itk::SmoothTriangleSurfaceNormals(*surface);
      table.Add({ name, NameOf(mode), Fixed(before, 2), Fixed(angle(), 2) });
    }
  }
  std::cout << "\nfields that are known exactly, of 40 samples along each axis\n";
  table.Print(std::cout);
}

} // namespace
} // namespace rhombic

int
main()
{
  rhombic::PrintCoarseScans();
  rhombic::PrintFineScans();
}
