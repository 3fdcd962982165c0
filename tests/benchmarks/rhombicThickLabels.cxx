#include "rhombicLabelSurfaces.h"
#include "rhombicRunBenchmark.h"
#include "rhombicTextTable.h"
#include "rhombicThickMaps.h"

#include "detail/itkPositionArithmetic.h"
#include "itkImageFileWriter.h"
#include "itkLabelMapFileReader.h"
#include "itkNiftiImageIO.h"
#include "itkShrinkImageFilter.h"
#include "itkTriangleSurfaceDistance.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include <vtkDiscreteFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkWindowedSincPolyDataFilter.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <map>
#include <numeric>

namespace
{

using namespace rhombic;
using MapImage = itk::Image<std::uint16_t, 3>;
using Surface = itk::TriangleSurface;

struct Options
{
  ThickMapSettings map;
  std::string output;
  std::vector<std::string> scans;
  double slices = 5.0; // mm, of the scans' maps
};

/** The surfaces of all labels of a map, from label 1 on. */
using Surfaces = std::vector<Surface::Pointer>;

std::vector<LabelSummary>
LabelsOf(const MapImage::Pointer & map)
{
  Scan scan;
  scan.image = map;
  return SummarizeLabels(scan, {});
}

/** The mean turn in degrees at the corners of the curves where walls of three labels or more meet. */
double
FindTurnOfCurves(const itk::LabelWalls & walls)
{
  std::map<std::array<std::uint32_t, 2>, int> edges; // and their triangles
  for (const auto & triangle : walls.GetTriangles())
  {
    for (unsigned int corner = 0; corner < 3; ++corner)
    {
      const auto [low, high] = std::minmax(triangle[corner], triangle[(corner + 1) % 3]);
      ++edges[{ low, high }];
    }
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> neighbours;
  for (const auto & [edge, triangles] : edges)
  {
    if (triangles > 2)
    {
      neighbours[edge[0]].push_back(edge[1]);
      neighbours[edge[1]].push_back(edge[0]);
    }
  }
  double sum = 0.0;
  double corners = 0.0;
  for (const auto & [point, beside] : neighbours)
  {
    if (beside.size() == 2)
    {
      const auto at = [&walls](std::uint32_t id) { return itk::ToPosition(walls.GetPoints()[id]); };
      const Vector3 before = Subtract(at(point), at(beside[0]));
      const Vector3 after = Subtract(at(beside[1]), at(point));
      sum += std::atan2(Length(Cross(before, after)), Dot(before, after)) * 180.0 / std::acos(-1.0);
      ++corners;
    }
  }
  return sum / corners;
}

/** \param pieces if not null, is set to the number of pieces of each label in the map */
Surfaces
MakeRhombicSurfaces(MapImage * image, std::vector<std::size_t> * pieces = nullptr)
{
  LabelMap map;
  map.scan.image = MapImage::Pointer(image);
  map.labels = LabelsOf(image);
  LabelMesh mesh = LabelsToWalls(map, {}, {});
  ExtractSurfaces(mesh);
  std::cout << "turn of the curves where walls meet: " << Fixed(FindTurnOfCurves(*mesh.walls.front()), 1)
            << " degrees a corner\n";
  Surfaces surfaces;
  for (const LabelSurface & label : mesh.labels)
  {
    surfaces.push_back(const_cast<Surface *>(label.scene.surface.GetPointer()));
    pieces != nullptr ? pieces->push_back(label.pieces) : void();
  }
  return surfaces;
}

Surface::Pointer
FromVTK(vtkPolyData & mesh, const MapImage & map)
{
  const auto surface = Surface::New();
  for (vtkIdType n = 0; n < mesh.GetNumberOfPoints(); ++n)
  {
    const itk::ContinuousIndex<double, 3> index(mesh.GetPoint(n));
    const auto point = map.TransformContinuousIndexToPhysicalPoint<double>(index);
    surface->GetPoints().push_back(itk::ToPoint({ point[0], point[1], point[2] }));
  }
  vtkNew<vtkIdList> ids;
  for (vtkIdType n = 0; n < mesh.GetNumberOfCells(); ++n)
  {
    mesh.GetCellPoints(n, ids);
    surface->GetTriangles().push_back({ static_cast<std::uint32_t>(ids->GetId(0)),
                                        static_cast<std::uint32_t>(ids->GetId(1)),
                                        static_cast<std::uint32_t>(ids->GetId(2)) });
  }
  return surface;
}

/** Surfaces of labels as 3D Slicer makes them by default: in indices, 20 iterations, pass band 0.01. */
Surfaces
MakeVTKSurfaces(const MapImage & map, const std::vector<std::int32_t> & labels)
{
  vtkNew<vtkImageData> image;
  const auto & size = map.GetBufferedRegion().GetSize();
  image->SetDimensions(static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2]));
  image->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
  std::copy_n(map.GetBufferPointer(),
              map.GetBufferedRegion().GetNumberOfPixels(),
              static_cast<std::uint16_t *>(image->GetScalarPointer()));
  Surfaces surfaces;
  for (const std::int32_t label : labels)
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
    surfaces.push_back(FromVTK(*smoother->GetOutput(), map));
  }
  return surfaces;
}

/** How far a surface is from a structure. */
struct Errors
{
  double mean = 0.0;    ///< distance in mm, by area
  double common = 0.0;  ///< 95 % of the area is no farther away
  double degrees = 0.0; ///< mean angle between the normals of the triangles and of the structure
};

Errors
CompareWithTruth(const Surface & surface, const ThickStructure & structure)
{
  Errors errors;
  double total = 0.0;
  std::vector<std::array<double, 2>> distances; // and areas
  for (const auto & triangle : surface.GetTriangles())
  {
    const auto corners = itk::CornersOf(surface, triangle);
    const Vector3 normal = itk::AreaVector(corners);
    const double area = 0.5 * Length(normal);
    const Vector3 centre = Scaled(Add(corners[0], Add(corners[1], corners[2])), 1.0 / 3.0);
    Vector3 outwards;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      constexpr double step = 1e-3;
      Vector3 beside = centre;
      beside[axis] += step;
      const double ahead = structure.depth(beside);
      beside[axis] -= 2.0 * step;
      outwards[axis] = structure.depth(beside) - ahead;
    }
    const double distance = std::abs(structure.depth(centre));
    errors.mean += area * distance;
    errors.degrees +=
      area * std::atan2(Length(Cross(normal, outwards)), Dot(normal, outwards)) * 180.0 / std::acos(-1.0);
    total += area;
    distances.push_back({ distance, area });
  }
  std::sort(distances.begin(), distances.end());
  double area = 0.0;
  for (auto place = distances.begin(); place != distances.end() && area < 0.95 * total; ++place)
  {
    errors.common = (*place)[0];
    area += (*place)[1];
  }
  errors.mean /= total;
  errors.degrees /= total;
  return errors;
}

/** Adds a row for each label. */
void
Measure(const std::string & maker,
        const Surfaces & surfaces,
        const std::vector<ThickStructure> & structures,
        const MapImage & map,
        const std::vector<std::size_t> & pieces,
        TextTable & table)
{
  const auto & spacing = map.GetSpacing();
  std::vector<double> volumes(structures.size() + 1);
  for (std::size_t n = 0; n < map.GetBufferedRegion().GetNumberOfPixels(); ++n)
  {
    volumes[map.GetBufferPointer()[n]] += spacing[0] * spacing[1] * spacing[2];
  }
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const Surface & surface = *surfaces[n];
    const auto topology = ComputeTriangleSurfaceTopology(surface);
    std::vector<std::string> row{ structures[n].name, maker, Fixed(ComputeTriangleSurfaceBending(surface), 3) };
    if (structures[n].standsAlone)
    {
      const Errors errors = CompareWithTruth(surface, structures[n]);
      row.insert(row.end(), { Fixed(errors.mean, 3), Fixed(errors.common, 3), Fixed(errors.degrees, 1) });
    }
    else
    {
      row.insert(row.end(), 3, "-");
    }
    row.push_back(Fixed(100.0 * (ComputeTriangleSurfaceVolume(surface) / volumes[n + 1] - 1.0), 3));
    row.push_back(std::to_string(topology.components) + " of " + std::to_string(pieces[n]));
    row.push_back(std::to_string(topology.genus));
    row.push_back(std::to_string(surface.GetNumberOfTriangles()));
    table.Add(row);
  }
}

/** Adds a row of the means over labels.
 * \param references surfaces of the map before it was made coarse, by label */
void
MeasureScan(const std::vector<std::string> & names,
            const Surfaces & surfaces,
            const std::vector<LabelSummary> & labels,
            const std::map<std::int32_t, Surface::Pointer> & references,
            TextTable & table)
{
  std::array<double, 4> means{};
  double worst = 0.0;
  for (std::size_t n = 0; n < surfaces.size(); ++n)
  {
    const Surface & surface = *surfaces[n];
    const auto distance =
      ComputeTriangleSurfaceDistance(surface, itk::TriangleTree(*references.at(labels[n].label.value)));
    const double volume = std::abs(ComputeTriangleSurfaceVolume(surface)) / 1000.0;
    const double error = 100.0 * std::abs(volume / labels[n].millilitres - 1.0);
    const std::array<double, 4> figures{
      ComputeTriangleSurfaceBending(surface), distance.GetMean(), distance.FindPercentile(95.0), error
    };
    for (std::size_t figure = 0; figure < figures.size(); ++figure)
    {
      means[figure] += figures[figure] / static_cast<double>(surfaces.size());
    }
    worst = std::max(worst, labels[n].millilitres > 1.0 ? error : 0.0);
  }
  std::vector<std::string> row = names;
  row.push_back(std::to_string(surfaces.size()));
  std::transform(means.begin(), means.end(), std::back_inserter(row), [](double mean) { return Fixed(mean, 3); });
  row.push_back(Fixed(worst, 3));
  table.Add(row);
}

/** Every few slices of a label map, about \a step mm apart. */
MapImage::Pointer
Coarsen(const MapImage & map, double step)
{
  const auto shrink = itk::ShrinkImageFilter<MapImage, MapImage>::New();
  shrink->SetInput(&map);
  shrink->SetShrinkFactor(2, static_cast<unsigned int>(std::max(1L, std::lround(step / map.GetSpacing()[2]))));
  shrink->Update();
  return shrink->GetOutput();
}

void
MeasureScans(const Options & options)
{
  TextTable table({ "map", "by", "labels", "bending", "mean mm", "95 % mm", "volume %", "worst above 1 ml %" });
  for (const std::string & path : options.scans)
  {
    const auto reader = itk::LabelMapFileReader<MapImage>::New();
    reader->SetFileName(path);
    reader->Update();
    const MapImage::Pointer fine = reader->GetOutput();
    const auto surfaces = MakeRhombicSurfaces(fine);
    const auto labelsOfFine = LabelsOf(fine);
    std::map<std::int32_t, Surface::Pointer> references;
    for (std::size_t n = 0; n < labelsOfFine.size(); ++n)
    {
      references[labelsOfFine[n].label.value] = surfaces[n];
    }
    const auto coarse = Coarsen(*fine, options.slices);
    const auto labels = LabelsOf(coarse);
    std::vector<std::int32_t> values;
    for (const LabelSummary & label : labels)
    {
      values.push_back(label.label.value);
    }
    const std::string name = std::filesystem::path(path).filename().string();
    MeasureScan({ name, "Rhombic" }, MakeRhombicSurfaces(coarse), labels, references, table);
    MeasureScan({ name, "VTK" }, MakeVTKSurfaces(*coarse, values), labels, references, table);
  }
  table.Print(std::cout);
}

void
MeasureDrawn(const Options & options)
{
  const auto structures = MakeThickStructures();
  const auto map = MakeThickMap(structures, options.map);
  if (!options.output.empty())
  {
    const auto writer = itk::ImageFileWriter<MapImage>::New();
    writer->SetInput(map);
    writer->SetImageIO(itk::NiftiImageIO::New());
    writer->SetFileName(options.output);
    writer->UseCompressionOn();
    writer->Update();
  }
  std::vector<std::int32_t> values(structures.size());
  std::iota(values.begin(), values.end(), 1);
  TextTable table(
    { "label", "by", "bending", "mean mm", "95 % mm", "degrees", "volume %", "pieces", "holes", "triangles" });
  std::vector<std::size_t> pieces;
  const auto start = std::chrono::steady_clock::now();
  Measure("Rhombic", MakeRhombicSurfaces(map, &pieces), structures, *map, pieces, table);
  const auto middle = std::chrono::steady_clock::now();
  Measure("VTK", MakeVTKSurfaces(*map, values), structures, *map, pieces, table);
  const auto end = std::chrono::steady_clock::now();
  table.Print(std::cout);
  std::cout << "seconds with measures: Rhombic " << Fixed(std::chrono::duration<double>(middle - start).count(), 1)
            << ", VTK " << Fixed(std::chrono::duration<double>(end - middle).count(), 1) << '\n';
}

} // namespace

int
main(int argc, char ** argv)
{
  Options options;
  CLI::App app{ "Surfaces of labels drawn by hand on thick slices, beside VTK's and the truth",
                "rhombic-thick-labels" };
  app.add_option("--seed", options.map.seed, "of the unsteady hand")->capture_default_str();
  app.add_option("--write", options.output, "also write the map, as NIfTI, to look at its surfaces");
  app.add_option("--scan", options.scans, "instead, label maps made coarse along z, beside surfaces of all slices");
  app.add_option("--slices", options.slices, "distance of the slices of --scan, in mm")->capture_default_str();
  return RunBenchmark(
    app, argc, argv, [&options] { options.scans.empty() ? MeasureDrawn(options) : MeasureScans(options); });
}
