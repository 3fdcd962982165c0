#include "itkFCCLabelSurfaceFilter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkLabelMapFileReader.h"
#include "itkLabelWallsEditing.h"
#include "itkLabelsToFCCFilter.h"
#include "itkProbabilitiesToFCCFilter.h"
#include "itkTriangleSurfaceInterior.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <vtkDiscreteFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

/** rhombic-label-walls: walls of labels in scenes against the truth, beside other surfaces of labels.
 * rhombic-label-walls MAP: times, largest errors of volumes and flaws of the walls of a label map.
 * rhombic-label-walls MAP cut (or relaxed): the same up to that step. */
namespace
{

using Vector = std::array<double, 3>;
using LabelImage = itk::LabelsToFCCFilter::InputImageType;

/** Depths below the surfaces of outside, 0, and of up to eight labels, in mm. */
using Depths = std::array<double, 9>;

/** Regions of labels. A point belongs to the one of largest depth. */
struct Scene
{
  std::string name;
  std::uint16_t labels;
  std::function<Depths(const Vector &)> depthsAt;
};

double
DepthInBall(const Vector & p, const Vector & centre, double radius)
{
  return radius - std::hypot(p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]);
}

double
Dot(const Vector & a, const Vector & b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Depths of which the first are given, and all others so low that nothing belongs to them. */
Depths
MakeDepths(const std::vector<double> & given)
{
  Depths depths;
  depths.fill(-1e3);
  std::copy(given.begin(), given.end(), depths.begin());
  return depths;
}

/** Eight balls of radius 8.6 to 10 mm around the corners of a cube, so near that neighbours touch. */
Scene
MakeBalls(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  std::array<Vector, 8> centres;
  for (unsigned int n = 0; n < 8; ++n)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      centres[n][axis] = ((n >> axis & 1) != 0 ? 8.8 : -8.8) + shift(random);
    }
  }
  return { "touching balls", 8, [centres](const Vector & p) {
            Depths depths{};
            for (std::size_t n = 0; n < 8; ++n)
            {
              depths[n + 1] = DepthInBall(p, centres[n], 8.6 + 1.4 * static_cast<double>(n) / 7.0);
            }
            return depths;
          } };
}

Scene
MakeBallInBall()
{
  return { "ball in ball", 2, [](const Vector & p) {
            const double outer = DepthInBall(p, { 0.3, -0.2, 0.4 }, 19.0);
            const double inner = DepthInBall(p, { 3.1, 2.2, -1.7 }, 10.0);
            return MakeDepths({ -outer, std::min(outer, -inner), inner });
          } };
}

/** Slanted layers of 4 to 7 mm in a ball. */
Scene
MakeSlabs()
{
  return { "slabs in a ball", 7, [](const Vector & p) {
            const double outer = DepthInBall(p, { 0.3, -0.2, 0.4 }, 20.0);
            const double height = Dot(p, { 0.48, 0.36, 0.8 });
            constexpr double borders[] = { -1e3, -13.0, -8.0, -4.0, 1.0, 7.0, 12.0, 1e3 };
            Depths depths = MakeDepths({ -outer });
            for (std::size_t n = 0; n < 7; ++n)
            {
              depths[n + 1] = std::min({ outer, height - borders[n], borders[n + 1] - height });
            }
            return depths;
          } };
}

/** A leaning torus in three pieces. */
Scene
MakeTorus()
{
  return { "torus cut in three", 3, [](const Vector & p) {
            const double x = Dot(p, { 0.8, 0.0, -0.6 });
            const double y = p[1];
            const double z = Dot(p, { 0.6, 0.0, 0.8 });
            const double torus = 6.5 - std::hypot(std::hypot(x, y) - 15.0, z);
            Depths depths = MakeDepths({ -torus });
            for (unsigned int n = 0; n < 3; ++n)
            {
              constexpr double third = 2.0 * 3.14159265358979 / 3.0;
              const auto side = [&](double angle) { return x * std::sin(angle) - y * std::cos(angle); };
              depths[n + 1] = std::min({ torus, -side(0.3 + n * third), side(0.3 + (n + 1) * third) });
            }
            return depths;
          } };
}

/** A ball cut in half, and one half cut again. */
Scene
MakeTJunction()
{
  return { "T-junction in a ball", 3, [](const Vector & p) {
            const double outer = DepthInBall(p, { 0.3, -0.2, 0.4 }, 18.0);
            const double first = Dot(p, { 0.8, 0.36, 0.48 }) - 0.7;
            const double second = Dot(p, { -0.6, 0.48, 0.64 }) + 0.4;
            return MakeDepths({ -outer,
                                std::min(outer, first),
                                std::min({ outer, -first, second }),
                                std::min({ outer, -first, -second }) });
          } };
}

LabelImage::Pointer
MakeMap(const Scene & scene, double slices)
{
  const auto image = LabelImage::New();
  const auto count = static_cast<itk::SizeValueType>(52.0 / slices);
  image->SetRegions(LabelImage::SizeType{ { 52, 52, count } });
  const double spacing[3] = { 1.0, 1.0, slices };
  image->SetSpacing(spacing);
  const double origin[3] = { -25.7, -25.6, -0.5 * slices * static_cast<double>(count - 1) + 0.1 * slices };
  image->SetOrigin(origin);
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<LabelImage> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto point = image->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    const Depths depths = scene.depthsAt({ point[0], point[1], point[2] });
    it.Set(static_cast<std::uint16_t>(std::max_element(depths.begin(), depths.end()) - depths.begin()));
  }
  return image;
}

/** Errors of surfaces: sums over triangles, by their area. */
class Errors
{
public:
  explicit Errors(const Scene & scene)
    : m_Scene(scene)
  {}

  void
  Add(const Vector & a, const Vector & b, const Vector & c)
  {
    Vector u;
    Vector v;
    Vector middle;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      u[axis] = b[axis] - a[axis];
      v[axis] = c[axis] - a[axis];
      middle[axis] = (a[axis] + b[axis] + c[axis]) / 3.0;
    }
    const Vector normal{ u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0] };
    const double area = 0.5 * std::hypot(normal[0], normal[1], normal[2]);
    if (!(area > 0.0))
    {
      return;
    }
    // The nearest wall is that between the two largest depths.
    const Depths depths = m_Scene.depthsAt(middle);
    std::array<std::size_t, 9> order{ { 0, 1, 2, 3, 4, 5, 6, 7, 8 } };
    std::partial_sort(order.begin(), order.begin() + 3, order.end(), [&](std::size_t m, std::size_t n) {
      return depths[m] > depths[n];
    });
    const Vector gradient = this->DifferentiateDepths(order[0], order[1], middle);
    const double slope = std::sqrt(Dot(gradient, gradient));
    const double angle =
      std::acos(std::min(1.0, std::abs(Dot(normal, gradient)) / (2.0 * area * slope))) * 180.0 / 3.14159265358979;
    m_Area += area;
    m_Distance += area * (depths[order[0]] - depths[order[1]]) / slope;
    m_Angle += area * angle;
    constexpr double nearJunction = 1.0; // mm
    if (depths[order[0]] - depths[order[2]] < nearJunction)
    {
      m_JunctionArea += area;
      m_JunctionAngle += area * angle;
    }
  }

  void
  Add(const itk::TriangleSurface & surface)
  {
    for (const auto & triangle : surface.GetTriangles())
    {
      Vector corners[3];
      for (unsigned int n = 0; n < 3; ++n)
      {
        const auto & p = surface.GetPoints()[triangle[n]];
        corners[n] = { p[0], p[1], p[2] };
      }
      this->Add(corners[0], corners[1], corners[2]);
    }
  }

  double
  GetDistance() const
  {
    return m_Distance / m_Area;
  }
  double
  GetAngle() const
  {
    return m_Angle / m_Area;
  }

  /** Of facets within 1 mm of a junction of walls. */
  double
  GetJunctionAngle() const
  {
    return m_JunctionAngle / m_JunctionArea;
  }

private:
  /** The gradient of the difference of two depths. */
  Vector
  DifferentiateDepths(std::size_t one, std::size_t other, const Vector & p) const
  {
    constexpr double step = 1e-4;
    Vector gradient;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      Vector before = p;
      Vector behind = p;
      before[axis] -= step;
      behind[axis] += step;
      const Depths low = m_Scene.depthsAt(before);
      const Depths high = m_Scene.depthsAt(behind);
      gradient[axis] = (high[one] - high[other] - low[one] + low[other]) / (2.0 * step);
    }
    return gradient;
  }

  const Scene & m_Scene;
  double m_Area = 0.0;
  double m_Distance = 0.0;
  double m_Angle = 0.0;
  double m_JunctionArea = 0.0;
  double m_JunctionAngle = 0.0;
};

/** The difference between a volume and that of a label's voxels, in per cent. */
double
VolumeError(const LabelImage & map, std::uint16_t label, double volume)
{
  const auto & spacing = map.GetSpacing();
  const auto * const begin = map.GetBufferPointer();
  const auto count = std::count(begin, begin + map.GetBufferedRegion().GetNumberOfPixels(), label);
  return 100.0 * (volume / (static_cast<double>(count) * spacing[0] * spacing[1] * spacing[2]) - 1.0);
}

using Surfaces = std::vector<itk::TriangleSurface::ConstPointer>;

/** How surfaces fit together: samples near walls between labels that are in none or in several of them. */
struct Fit
{
  double gaps = 0.0;     ///< mm^3
  double overlaps = 0.0; ///< mm^3
};

Fit
MeasureFit(const Scene & scene, const Surfaces & surfaces)
{
  constexpr itk::SizeValueType size = 208;
  constexpr double step = 0.25;
  constexpr double nearWall = 1.0; // mm
  itk::SamplePlanes planes;
  planes.columnStep[0] = planes.rowStep[1] = step;
  planes.numberOfColumns = planes.numberOfRows = size;
  for (itk::SizeValueType k = 0; k < size; ++k)
  {
    itk::Point<double, 3> origin(-26.003);
    origin[2] += step * static_cast<double>(k);
    planes.origins.push_back(origin);
  }
  std::vector<std::uint8_t> uses(size * size * size);
  for (const auto & surface : surfaces)
  {
    itk::FindTriangleSurfaceInteriorSamples(*surface, planes, [&uses](auto plane, auto row, auto begin, auto end) {
      for (auto column = begin; column < end; ++column)
      {
        ++uses[(plane * size + row) * size + column];
      }
    });
  }
  Fit fit;
  for (std::size_t n = 0; n < uses.size(); ++n)
  {
    if (uses[n] != 1)
    {
      const itk::Point<double, 3> & origin = planes.origins[n / (size * size)];
      Depths depths = scene.depthsAt({ origin[0] + step * static_cast<double>(n % size),
                                       origin[1] + step * static_cast<double>(n / size % size),
                                       origin[2] });
      const double outside = depths[0];
      std::partial_sort(depths.begin(), depths.begin() + 2, depths.end(), std::greater<>());
      // Between two labels, far from outside.
      const bool isWall = depths[1] > outside + nearWall;
      fit.gaps += isWall && uses[n] == 0 ? step * step * step : 0.0;
      fit.overlaps += isWall && uses[n] > 1 ? step * step * step : 0.0;
    }
  }
  return fit;
}

/** The mean results of a method for some scenes. */
class Results
{
public:
  Results(const std::vector<Scene> & scenes, double slices)
    : m_Scenes(scenes)
    , m_Slices(slices)
  {}

  /** Adds the surfaces of the labels of the next scene; \a mesh has all of their triangles. */
  void
  Add(const itk::TriangleSurface & mesh, const Surfaces & surfaces)
  {
    const Scene & scene = m_Scenes[m_Count++];
    const auto map = MakeMap(scene, m_Slices);
    Errors errors(scene);
    errors.Add(mesh);
    const Fit fit = MeasureFit(scene, surfaces);
    const double share = 1.0 / static_cast<double>(m_Scenes.size());
    m_Distance += share * errors.GetDistance();
    m_Angle += share * errors.GetAngle();
    m_JunctionAngle += share * errors.GetJunctionAngle();
    m_Fit.gaps += share * fit.gaps;
    m_Fit.overlaps += share * fit.overlaps;
    m_Triangles += share * static_cast<double>(mesh.GetNumberOfTriangles());
    for (std::size_t n = 0; n < surfaces.size(); ++n)
    {
      const double volume = itk::ComputeTriangleSurfaceVolume(*surfaces[n]);
      m_Volume = std::max(m_Volume, std::abs(VolumeError(*map, static_cast<std::uint16_t>(n + 1), volume)));
    }
  }

  void
  Print(const char * method) const
  {
    std::printf("%-20s %4.0f %8.3f %8.2f %9.2f %9.2f %9.1f %9.1f %10.0f\n",
                method,
                m_Slices,
                m_Distance,
                m_Angle,
                m_JunctionAngle,
                m_Volume,
                m_Fit.gaps,
                m_Fit.overlaps,
                m_Triangles);
    std::fflush(stdout);
  }

private:
  const std::vector<Scene> & m_Scenes;
  const double m_Slices;
  std::size_t m_Count = 0;
  double m_Distance = 0.0;
  double m_Angle = 0.0;
  double m_JunctionAngle = 0.0;
  double m_Volume = 0.0;
  double m_Triangles = 0.0;
  Fit m_Fit;
};

Surfaces
ExtractLabels(const itk::LabelWalls & walls)
{
  Surfaces surfaces;
  for (const auto label : walls.FindLabels())
  {
    surfaces.emplace_back(walls.ExtractLabel(label));
  }
  return surfaces;
}

template <typename TFilter>
itk::LabelWalls::Pointer
MakeWalls(const itk::SmartPointer<TFilter> & toLattice)
{
  toLattice->Update();
  const auto filter = itk::FCCLabelSurfaceFilter::New();
  filter->SetInput(toLattice->GetOutput());
  filter->SetWeights(toLattice->GetWeights());
  filter->Update();
  return filter->GetOutput();
}

/** Settings of relaxation for the scenes. */
itk::TriangleSurfaceSmoothingSettings
HalfAVoxel()
{
  itk::TriangleSurfaceSmoothingSettings smoothing;
  smoothing.maximumMove = 0.5;
  return smoothing;
}

/** Walls as they are cut, relaxed by half a voxel (of the shortest edge), and simplified to a tenth. */
void
MeasureWalls(const std::vector<Scene> & scenes, double slices)
{
  Results cut(scenes, slices);
  Results relaxed(scenes, slices);
  Results simplified(scenes, slices);
  for (const Scene & scene : scenes)
  {
    const auto toLattice = itk::LabelsToFCCFilter::New();
    toLattice->SetInput(MakeMap(scene, slices));
    const auto walls = MakeWalls(toLattice);
    cut.Add(*walls, ExtractLabels(*walls));
    itk::RelaxLabelWalls(*walls, HalfAVoxel());
    relaxed.Add(*walls, ExtractLabels(*walls));
    itk::TriangleSurfaceSimplificationSettings simplification;
    simplification.maximumError = 0.1;
    itk::SimplifyLabelWalls(*walls, simplification);
    simplified.Add(*walls, ExtractLabels(*walls));
  }
  cut.Print("walls");
  relaxed.Print("walls, relaxed");
  simplified.Print("walls, simplified");
}

/** The share of each voxel that each label fills, by samples in the voxel. */
std::vector<itk::Image<float, 3>::Pointer>
MakeProbabilities(const Scene & scene, double slices)
{
  constexpr int samples = 5; // along each axis
  std::vector<itk::Image<float, 3>::Pointer> volumes;
  const auto map = MakeMap(scene, slices);
  for (std::size_t n = 0; n < scene.labels; ++n)
  {
    volumes.push_back(itk::Image<float, 3>::New());
    volumes.back()->CopyInformation(map);
    volumes.back()->SetRegions(map->GetBufferedRegion());
    volumes.back()->Allocate(true);
  }
  for (itk::ImageRegionIteratorWithIndex<LabelImage> it(map, map->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto middle = map->TransformIndexToPhysicalPoint<double>(it.GetIndex());
    for (int n = 0; n < samples * samples * samples; ++n)
    {
      const auto place = [&](unsigned int axis, int sample) {
        return middle[axis] + map->GetSpacing()[axis] * ((sample + 0.5) / samples - 0.5);
      };
      const auto depths =
        scene.depthsAt({ place(0, n % samples), place(1, n / samples % samples), place(2, n / samples / samples) });
      const auto label = std::max_element(depths.begin(), depths.end()) - depths.begin();
      if (label > 0)
      {
        const auto volume = volumes[static_cast<std::size_t>(label - 1)];
        volume->SetPixel(it.GetIndex(), volume->GetPixel(it.GetIndex()) + 1.0f / (samples * samples * samples));
      }
    }
  }
  return volumes;
}

void
MeasureProbabilities(const std::vector<Scene> & scenes, double slices)
{
  Results cut(scenes, slices);
  Results relaxed(scenes, slices);
  for (const Scene & scene : scenes)
  {
    const auto toLattice = itk::ProbabilitiesToFCCFilter::New();
    const auto volumes = MakeProbabilities(scene, slices);
    for (unsigned int n = 0; n < volumes.size(); ++n)
    {
      toLattice->SetInput(n, volumes[n]);
    }
    const auto walls = MakeWalls(toLattice);
    cut.Add(*walls, ExtractLabels(*walls));
    itk::RelaxLabelWalls(*walls, HalfAVoxel());
    relaxed.Add(*walls, ExtractLabels(*walls));
  }
  cut.Print("probabilities");
  relaxed.Print("the same, relaxed");
}

/** All triangles of some surfaces. */
itk::TriangleSurface::Pointer
Join(const Surfaces & surfaces)
{
  const auto all = itk::TriangleSurface::New();
  for (const auto & surface : surfaces)
  {
    const auto first = static_cast<std::uint32_t>(all->GetNumberOfPoints());
    for (const auto & [a, b, c] : surface->GetTriangles())
    {
      all->GetTriangles().push_back({ first + a, first + b, first + c });
    }
    all->GetPoints().insert(all->GetPoints().end(), surface->GetPoints().begin(), surface->GetPoints().end());
  }
  return all;
}

/** A surface of a label as 3D Slicer makes it by default (vtkBinaryLabelmapToClosedSurfaceConversionRule): in indices,
 * 20 iterations, smoothing factor 0.5, which is a pass band of 0.01. */
itk::TriangleSurface::Pointer
MakeSlicerSurface(vtkImageData * image, int label, const LabelImage & map)
{
  vtkNew<vtkDiscreteFlyingEdges3D> edges;
  edges->SetInputData(image);
  edges->SetValue(0, label);
  vtkNew<vtkWindowedSincPolyDataFilter> smoother;
  smoother->SetInputConnection(edges->GetOutputPort());
  smoother->SetNumberOfIterations(20);
  smoother->SetPassBand(0.01);
  smoother->FeatureEdgeSmoothingOff();
  smoother->BoundarySmoothingOff();
  smoother->NonManifoldSmoothingOn();
  smoother->NormalizeCoordinatesOn();
  smoother->Update();
  vtkPolyData * const mesh = smoother->GetOutput();
  const auto surface = itk::TriangleSurface::New();
  for (vtkIdType n = 0; n < mesh->GetNumberOfPoints(); ++n)
  {
    itk::TriangleSurface::PointType point;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      point[axis] = static_cast<float>(map.GetOrigin()[axis] + map.GetSpacing()[axis] * mesh->GetPoint(n)[axis]);
    }
    surface->GetPoints().push_back(point);
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType n = 0; n < mesh->GetNumberOfCells(); ++n)
  {
    mesh->GetCellPoints(n, ids);
    surface->GetTriangles().push_back({ static_cast<std::uint32_t>(ids->GetId(0)),
                                        static_cast<std::uint32_t>(ids->GetId(1)),
                                        static_cast<std::uint32_t>(ids->GetId(2)) });
  }
  return surface;
}

void
MeasureVTK(const std::vector<Scene> & scenes, double slices)
{
  Results results(scenes, slices);
  for (const Scene & scene : scenes)
  {
    const auto map = MakeMap(scene, slices);
    vtkNew<vtkImageData> image;
    const auto & size = map->GetBufferedRegion().GetSize();
    image->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]));
    image->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
    std::copy_n(map->GetBufferPointer(),
                map->GetBufferedRegion().GetNumberOfPixels(),
                static_cast<std::uint16_t *>(image->GetScalarPointer()));
    Surfaces surfaces;
    for (int label = 1; label <= scene.labels; ++label)
    {
      surfaces.emplace_back(MakeSlicerSurface(image, label, *map));
    }
    results.Add(*Join(surfaces), surfaces);
  }
  results.Print("VTK as Slicer");
}

/** Prints the time of each step, and the volumes of labels of some sizes after it. */
void
MeasureMap(const char * path, const std::string & last)
{
  const auto reader = itk::LabelMapFileReader<LabelImage>::New();
  reader->SetFileName(path);
  reader->Update();
  const LabelImage::ConstPointer map = reader->GetOutput();
  const auto & spacing = map->GetSpacing();
  const double voxel = spacing[0] * spacing[1] * spacing[2];
  std::map<std::uint16_t, double> truth;
  for (std::size_t n = 0; n < map->GetBufferedRegion().GetNumberOfPixels(); ++n)
  {
    truth[map->GetBufferPointer()[n]] += voxel;
  }
  std::clock_t start = std::clock();
  auto startOfWall = std::chrono::steady_clock::now();
  const auto report = [&](const char * step, const itk::LabelWalls & walls) {
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - startOfWall;
    double large = 0.0;
    double small = 0.0;
    double sum = 0.0;
    double sumTruth = 0.0;
    std::size_t flaws = 0;
    for (const auto label : walls.FindLabels())
    {
      const auto surface = walls.ExtractLabel(label);
      const double volume = itk::ComputeTriangleSurfaceVolume(*surface);
      const double error = 100.0 * std::abs(volume / truth[label] - 1.0);
      double & worst = truth[label] > 1000.0 ? large : small;
      worst = std::max(worst, error);
      sum += volume;
      sumTruth += truth[label];
      flaws += itk::ComputeTriangleSurfaceTopology(*surface).IsWatertight() ? 0 : 1;
    }
    std::printf("%-20s %8.2f %8.2f %10zu %9.2f %9.2f %9.3f %6zu\n",
                step,
                seconds,
                wall.count(),
                static_cast<std::size_t>(walls.GetNumberOfTriangles()),
                large,
                small,
                100.0 * (sum / sumTruth - 1.0),
                flaws);
    std::fflush(stdout);
    start = std::clock();
    startOfWall = std::chrono::steady_clock::now();
  };
  std::printf("step                      cpu     wall  triangles   >1 ml %%   <1 ml %%     sum %%  flaws\n");
  const auto toLattice = itk::LabelsToFCCFilter::New();
  toLattice->SetInput(map);
  toLattice->Update();
  const auto filter = itk::FCCLabelSurfaceFilter::New();
  report("lattice", *filter->GetOutput());
  filter->SetInput(toLattice->GetOutput());
  filter->SetWeights(toLattice->GetWeights());
  filter->Update();
  itk::LabelWalls & walls = *filter->GetOutput();
  report("walls", walls);
  if (last == "cut")
  {
    return;
  }
  const double shortest = std::min({ spacing[0], spacing[1], spacing[2] });
  itk::TriangleSurfaceSmoothingSettings smoothing;
  smoothing.maximumMove = 0.5 * shortest;
  itk::RelaxLabelWalls(walls, smoothing, toLattice->GetVoxelVolumes());
  report("relaxed", walls);
  if (last == "relaxed")
  {
    return;
  }
  itk::TriangleSurfaceSimplificationSettings simplification;
  simplification.maximumError = 0.1 * shortest;
  itk::SimplifyLabelWalls(walls, simplification);
  report("simplified", walls);
}

} // namespace

int
main(int argc, char ** argv)
try
{
  if (argc > 1)
  {
    MeasureMap(argv[1], argc > 2 ? argv[2] : "");
    return 0;
  }
  std::vector<Scene> balls;
  for (unsigned int seed = 1; seed <= 4; ++seed)
  {
    balls.push_back(MakeBalls(seed));
  }
  const std::vector<std::vector<Scene>> groups{
    balls, { MakeBallInBall() }, { MakeSlabs() }, { MakeTorus() }, { MakeTJunction() }
  };
  for (const auto & scenes : groups)
  {
    std::printf("%-20s slices    mm  degrees  junction  volume %%  gaps mm3  overlaps  triangles\n",
                scenes.front().name.c_str());
    for (const double slices : { 1.0, 3.0, 6.0 })
    {
      MeasureWalls(scenes, slices);
      MeasureProbabilities(scenes, slices);
      MeasureVTK(scenes, slices);
    }
  }
}
catch (const std::exception & error)
{
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
