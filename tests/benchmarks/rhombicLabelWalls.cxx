#include "itkFCCLabelSurfaceFilter.h"
#include "itkImageRegionIteratorWithIndex.h"
#include "itkLabelMapFileReader.h"
#include "itkLabelsToFCCFilter.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"
#include "rhombicLabelSurfaces.h"

#include <vtkDiscreteFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <cstdio>
#include <exception>
#include <random>
#include <utility>
#include <vector>

/** rhombic-label-walls: walls of eight touching balls against the truth, beside other surfaces of labels.
 * rhombic-label-walls MAP: volumes and flaws of the walls of a label map. */
namespace
{

using Vector = std::array<double, 3>;
using LabelImage = itk::LabelsToFCCFilter::InputImageType;

struct Ball
{
  Vector centre;
  double radius;
};

/** Eight balls of radius 8.6 to 10 mm around the corners of a cube, so near that neighbours touch. */
std::vector<Ball>
MakeBalls(unsigned int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shift(-0.4, 0.4);
  std::vector<Ball> balls;
  for (unsigned int n = 0; n < 8; ++n)
  {
    Ball ball{ {}, 8.6 + 1.4 * n / 7.0 };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      ball.centre[axis] = ((n >> axis & 1) != 0 ? 8.8 : -8.8) + shift(random);
    }
    balls.push_back(ball);
  }
  return balls;
}

/** Depths below the surfaces of outside, which is 0 everywhere, and of the balls. */
std::array<double, 9>
DepthsAt(const std::vector<Ball> & balls, const Vector & p)
{
  std::array<double, 9> depths{};
  for (std::size_t n = 0; n < 8; ++n)
  {
    const Vector & c = balls[n].centre;
    depths[n + 1] = balls[n].radius - std::hypot(p[0] - c[0], p[1] - c[1], p[2] - c[2]);
  }
  return depths;
}

LabelImage::Pointer
MakeMap(const std::vector<Ball> & balls, double slices)
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
    const auto depths = DepthsAt(balls, { point[0], point[1], point[2] });
    it.Set(static_cast<std::uint16_t>(std::max_element(depths.begin(), depths.end()) - depths.begin()));
  }
  return image;
}

/** Errors of surfaces: sums over triangles, by their area. */
class Errors
{
public:
  explicit Errors(const std::vector<Ball> & balls)
    : m_Balls(balls)
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
    const auto depths = DepthsAt(m_Balls, middle);
    std::array<std::size_t, 9> order{ { 0, 1, 2, 3, 4, 5, 6, 7, 8 } };
    std::partial_sort(order.begin(), order.begin() + 2, order.end(), [&](std::size_t m, std::size_t n) {
      return depths[m] > depths[n];
    });
    const Vector first = this->GradientOf(order[0], middle);
    const Vector second = this->GradientOf(order[1], middle);
    const Vector gradient{ first[0] - second[0], first[1] - second[1], first[2] - second[2] };
    const double slope = std::hypot(gradient[0], gradient[1], gradient[2]);
    const double dot = normal[0] * gradient[0] + normal[1] * gradient[1] + normal[2] * gradient[2];
    m_Area += area;
    m_Distance += area * (depths[order[0]] - depths[order[1]]) / slope;
    m_Angle += area * std::acos(std::min(1.0, std::abs(dot) / (2.0 * area * slope))) * 180.0 / 3.14159265358979;
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

private:
  Vector
  GradientOf(std::size_t label, const Vector & p) const
  {
    if (label == 0)
    {
      return {};
    }
    const Vector & c = m_Balls[label - 1].centre;
    const double distance = std::hypot(p[0] - c[0], p[1] - c[1], p[2] - c[2]);
    return { (c[0] - p[0]) / distance, (c[1] - p[1]) / distance, (c[2] - p[2]) / distance };
  }

  const std::vector<Ball> & m_Balls;
  double m_Area = 0.0;
  double m_Distance = 0.0;
  double m_Angle = 0.0;
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

void
Print(const char * method, double slices, const std::vector<Errors> & errors, double volume, std::clock_t start)
{
  double distance = 0.0;
  double angle = 0.0;
  for (const Errors & each : errors)
  {
    distance += each.GetDistance() / static_cast<double>(errors.size());
    angle += each.GetAngle() / static_cast<double>(errors.size());
  }
  std::printf("%-28s %4.0f %8.3f %8.2f %8.2f %8.2f\n",
              method,
              slices,
              distance,
              angle,
              volume,
              static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  std::fflush(stdout);
}

void
MeasureWalls(const std::vector<std::vector<Ball>> & scenes, double slices)
{
  const std::clock_t start = std::clock();
  std::vector<Errors> errors;
  double worst = 0.0;
  for (const auto & balls : scenes)
  {
    const auto map = MakeMap(balls, slices);
    const auto toLattice = itk::LabelsToFCCFilter::New();
    toLattice->SetInput(map);
    toLattice->Update();
    const auto filter = itk::FCCLabelSurfaceFilter::New();
    filter->SetInput(toLattice->GetOutput());
    filter->SetWeights(toLattice->GetWeights());
    filter->Update();
    errors.emplace_back(balls).Add(*filter->GetOutput());
    for (const auto label : filter->GetOutput()->FindLabels())
    {
      const double volume = itk::ComputeVolume(*filter->GetOutput()->ExtractLabel(label));
      worst = std::max(worst, std::abs(VolumeError(*map, label, volume)));
    }
  }
  Print("walls", slices, errors, worst, start);
}

void
MeasureLabelSurfaces(const std::vector<std::vector<Ball>> & scenes, double slices)
{
  const std::clock_t start = std::clock();
  std::vector<Errors> errors;
  double worst = 0.0;
  for (const auto & balls : scenes)
  {
    const auto image = MakeMap(balls, slices);
    rhombic::LabelMap map;
    map.scan.image = image;
    map.labels = rhombic::SummarizeLabels(map.scan, {});
    errors.emplace_back(balls);
    for (const auto & made : rhombic::LabelsToSurfaces(map, {}, {}))
    {
      errors.back().Add(*made.scene.surface);
      worst = std::max(worst, 100.0 * std::abs(made.GetVolumeDifference()));
    }
  }
  Print("label surfaces", slices, errors, worst, start);
}

/** Slicer's closed surfaces: smoothing factor 0.5, so 40 iterations and a pass band of 0.01. */
void
MeasureVTK(const std::vector<std::vector<Ball>> & scenes, double slices)
{
  const std::clock_t start = std::clock();
  std::vector<Errors> errors;
  for (const auto & balls : scenes)
  {
    const auto map = MakeMap(balls, slices);
    errors.emplace_back(balls);
    vtkNew<vtkImageData> image;
    const auto & size = map->GetBufferedRegion().GetSize();
    image->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]));
    image->SetSpacing(map->GetSpacing().GetDataPointer());
    image->SetOrigin(map->GetOrigin().GetDataPointer());
    image->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
    std::copy_n(map->GetBufferPointer(),
                map->GetBufferedRegion().GetNumberOfPixels(),
                static_cast<std::uint16_t *>(image->GetScalarPointer()));
    for (int label = 1; label <= 8; ++label)
    {
      vtkNew<vtkDiscreteFlyingEdges3D> edges;
      edges->SetInputData(image);
      edges->SetValue(0, label);
      vtkNew<vtkWindowedSincPolyDataFilter> smoother;
      smoother->SetInputConnection(edges->GetOutputPort());
      smoother->SetNumberOfIterations(40);
      smoother->SetPassBand(0.01);
      smoother->FeatureEdgeSmoothingOff();
      smoother->BoundarySmoothingOff();
      smoother->NonManifoldSmoothingOn();
      smoother->NormalizeCoordinatesOn();
      smoother->Update();
      vtkPolyData * const mesh = smoother->GetOutput();
      for (vtkIdType n = 0; n < mesh->GetNumberOfCells(); ++n)
      {
        vtkNew<vtkIdList> ids;
        mesh->GetCellPoints(n, ids);
        Vector corners[3];
        for (vtkIdType corner = 0; corner < 3; ++corner)
        {
          mesh->GetPoint(ids->GetId(corner), corners[corner].data());
        }
        errors.back().Add(corners[0], corners[1], corners[2]);
      }
    }
  }
  Print("VTK, windowed sinc", slices, errors, std::nan(""), start);
}

/** Prints the volume and the flaws of each label's surface. */
void
MeasureMap(const char * path)
{
  const auto reader = itk::LabelMapFileReader<LabelImage>::New();
  reader->SetFileName(path);
  reader->Update();
  const LabelImage::ConstPointer map = reader->GetOutput();
  std::clock_t start = std::clock();
  const auto secondsSince = [&start] {
    const std::clock_t begin = std::exchange(start, std::clock());
    return static_cast<double>(start - begin) / CLOCKS_PER_SEC;
  };
  const auto toLattice = itk::LabelsToFCCFilter::New();
  toLattice->SetInput(map);
  toLattice->Update();
  const double latticeSeconds = secondsSince();
  const auto filter = itk::FCCLabelSurfaceFilter::New();
  filter->SetInput(toLattice->GetOutput());
  filter->SetWeights(toLattice->GetWeights());
  filter->Update();
  const double surfaceSeconds = secondsSince();
  const itk::LabelWalls & walls = *filter->GetOutput();
  std::printf("%zu sites, %zu weights, %zu triangles; cpu: %.2f s to the lattice, %.2f s for the walls\n",
              static_cast<std::size_t>(toLattice->GetOutput()->GetLargestPossibleRegion().GetNumberOfPixels()),
              static_cast<std::size_t>(toLattice->GetWeights()->GetNumberOfWeights()),
              static_cast<std::size_t>(walls.GetNumberOfTriangles()),
              latticeSeconds,
              surfaceSeconds);
  std::printf("label       ml  volume %%  watertight\n");
  for (const auto label : walls.FindLabels())
  {
    const auto surface = walls.ExtractLabel(label);
    const double volume = itk::ComputeVolume(*surface);
    std::printf("%5d %8.2f %9.2f  %s\n",
                static_cast<int>(label),
                volume / 1000.0,
                VolumeError(*map, label, volume),
                itk::ComputeTopology(*surface).IsWatertight() ? "yes" : "NO");
  }
}

} // namespace

int
main(int argc, char ** argv)
try
{
  if (argc > 1)
  {
    MeasureMap(argv[1]);
    return 0;
  }
  std::vector<std::vector<Ball>> scenes;
  for (unsigned int seed = 1; seed <= 4; ++seed)
  {
    scenes.push_back(MakeBalls(seed));
  }
  std::printf("method                     slices       mm  degrees   volume      cpu\n");
  for (const double slices : { 1.0, 3.0, 6.0 })
  {
    MeasureWalls(scenes, slices);
    MeasureLabelSurfaces(scenes, slices);
    MeasureVTK(scenes, slices);
  }
}
catch (const std::exception & error)
{
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
