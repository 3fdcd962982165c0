#include "rhombicComparedMethod.h"

#include "detail/itkPositionArithmetic.h"

#include "rhombicCartesianSurfaces.h"
#include "rhombicExtractSurface.h"
#include "rhombicFailure.h"
#include "rhombicReferenceField.h"
#include "rhombicFieldSampling.h"
#include "rhombicWording.h"

#include <algorithm>
#include <map>

namespace rhombic
{
namespace
{

using VolumeType = itk::Image<float, 3>;
using LatticeType = itk::FCCImage<float>;

/** The number of steps of a length that cover each side of a box. */
std::array<itk::SizeValueType, 3>
StepsAlong(const FieldBox & box, double step)
{
  std::array<itk::SizeValueType, 3> steps;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    steps[axis] = static_cast<itk::SizeValueType>(std::ceil((box.upper[axis] - box.lower[axis]) / step - 1e-6));
  }
  return steps;
}

ComparedMethod
OnCartesian(const std::string & name, itk::TriangleSurface::Pointer (*extract)(const VolumeType *))
{
  return { name, "Cartesian", [extract](const ReferenceField & field, const FieldBox & box, double density) {
            const VolumeType::Pointer volume = SampleBox(field, box, std::cbrt(1.0 / density));
            return PreparedMethod{ volume->GetBufferedRegion().GetNumberOfPixels(),
                                   [volume, extract] { return extract(volume); } };
          } };
}

ComparedMethod
OnFCC(ExtractionMode mode)
{
  return { NameOf(mode), "FCC", [mode](const ReferenceField & field, const FieldBox & box, double density) {
            const double spacing = std::cbrt(1.0 / (itk::FCCLattice::CellVolume * density));
            const auto steps = StepsAlong(box, spacing);
            const LatticeType::Pointer lattice =
              SampleField<LatticeType>(field, { { steps[0] / 2 + 1, steps[1] + 1, steps[2] + 1 } }, spacing, box.lower);
            return PreparedMethod{ lattice->GetBufferedRegion().GetNumberOfPixels(),
                                   [lattice, mode] { return ExtractSurface(lattice.GetPointer(), 0.0, mode, true); } };
          } };
}

template <itk::TriangleSurface::Pointer (*TMarch)(const TetrahedraGrid &)>
PreparedMethod
PrepareBCC(const ReferenceField & field, const FieldBox & box, double density)
{
  constexpr double cellVolume = 4.0; // of a site, in units of the spacing
  const double spacing = std::cbrt(1.0 / (cellVolume * density));
  const auto steps = StepsAlong(box, spacing);
  const auto sizeAlong = [&steps](unsigned int axis) { return static_cast<int>(steps[axis]) + 1; };
  auto grid = std::make_shared<TetrahedraGrid>(
    SampleOnBCC(field, box.lower, { sizeAlong(0), sizeAlong(1), sizeAlong(2) }, spacing));
  const auto samples = std::count_if(grid->values.begin(), grid->values.end(), [](float v) { return !std::isnan(v); });
  return { static_cast<itk::SizeValueType>(samples), [grid] { return TMarch(*grid); } };
}

itk::TriangleSurface::Pointer
RunVTK(VTKExtractor extractor, const VolumeType * volume)
{
  return PolyDataToSurface(ExtractWithVTK(extractor, ShareWithVTK(volume), 0.0, true));
}

itk::TriangleSurface::Pointer
RunFlyingEdges(const VolumeType * volume)
{
  return RunVTK(VTKExtractor::FlyingEdges, volume);
}

itk::TriangleSurface::Pointer
RunTetrahedra(const VolumeType * volume)
{
  return MarchTetrahedra(CartesianTetrahedra(volume));
}

template <itk::TriangleSurface::Pointer (*TExtract)(const VolumeType *)>
itk::TriangleSurface::Pointer
WithCubicPoints(const VolumeType * volume)
{
  auto surface = TExtract(volume);
  MovePointsToCubics(volume, *surface);
  return surface;
}

} // namespace

VolumeType::Pointer
SampleBox(const ReferenceField & field, const FieldBox & box, double spacing)
{
  const auto steps = StepsAlong(box, spacing);
  return SampleField<VolumeType>(field, { { steps[0] + 1, steps[1] + 1, steps[2] + 1 } }, spacing, box.lower);
}

const std::vector<ComparedMethod> &
GetComparedMethods()
{
  static const std::vector<ComparedMethod> methods{
    OnCartesian("cuberille", ExtractCuberille),
    OnCartesian("marching-cubes", [](const VolumeType * v) { return RunVTK(VTKExtractor::MarchingCubes, v); }),
    OnCartesian("flying-edges", RunFlyingEdges),
    OnCartesian("marching-cubes-cubic", WithCubicPoints<RunFlyingEdges>),
    OnCartesian("marching-tetrahedra", RunTetrahedra),
    OnCartesian("marching-tetrahedra-cubic", WithCubicPoints<RunTetrahedra>),
    { "bcc-tetrahedra", "BCC", PrepareBCC<MarchTetrahedra> },
    { "bcc-octahedra", "BCC", PrepareBCC<MarchBCCOctahedra> },
    { "bcc-hexahedra", "BCC", PrepareBCC<MarchBCCHexahedra> },
    OnFCC(ExtractionMode::Parallelepipeds),
    OnFCC(ExtractionMode::Tetrahedra),
    OnFCC(ExtractionMode::Octahedra),
    OnFCC(ExtractionMode::Fine),
    OnFCC(ExtractionMode::Lean)
  };
  return methods;
}

const ComparedMethod &
GetComparedMethod(const std::string & name)
{
  std::vector<std::string> names;
  for (const ComparedMethod & method : GetComparedMethods())
  {
    if (method.name == name)
    {
      return method;
    }
    names.push_back(method.name);
  }
  throw Failure(FailureKind::Usage, DescribeUnknown("method", name, names, "use " + Enumerate(names)));
}

double
DensityOfSamples(const ComparedMethod & method, const FieldBox & box, double samples)
{
  const ReferenceField zero([](const Vector3 &, Vector3 &) { return 0.0; });
  double volume = 1.0;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    volume *= box.upper[axis] - box.lower[axis];
  }
  const auto excess = [&](double density) {
    return static_cast<double>(method.prepare(zero, box, density).samples) - samples;
  };
  constexpr unsigned int steps = 30;
  double low = 0.3 * samples / volume; // lattices that cover a box have more samples than this
  double high = 1.2 * samples / volume;
  for (unsigned int step = 0; step < steps; ++step)
  {
    const double middle = std::sqrt(low * high);
    (excess(middle) < 0.0 ? low : high) = middle;
  }
  return std::abs(excess(low)) < std::abs(excess(high)) ? low : high;
}

itk::TriangleSurface::Pointer
MakeTrueSurface(const ReferenceField & field, const FieldBox & box, double spacing)
{
  const auto volume = SampleBox(field, box, spacing);
  auto surface = RunVTK(VTKExtractor::FlyingEdges, volume);
  surface->GetNormals().clear();
  auto & points = surface->GetPoints();
  ForEachInBlocks(points.size(), 256, [&](itk::SizeValueType n) {
    auto & p = points[n];
    const FieldProjection projection = ProjectOntoField(field, itk::ToPosition(p), spacing);
    if (projection.isResolved && projection.distance < spacing)
    {
      p = itk::ToPoint(projection.point);
    }
  });
  return surface;
}

itk::TriangleSurface::Pointer
MakeBisectedSphere(const Vector3 & center, double radius, unsigned int bisections)
{
  using Triangle = itk::TriangleSurface::TriangleType;
  std::vector<Vector3> points{ { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } };
  std::vector<Triangle> triangles{ { 0, 1, 2 }, { 0, 3, 1 }, { 0, 2, 3 }, { 1, 3, 2 } };
  for (unsigned int bisection = 0; bisection < bisections; ++bisection)
  {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, isNew] = middles.emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (isNew)
      {
        const Vector3 sum = Add(points[a], points[b]);
        points.push_back(Scaled(sum, std::sqrt(3.0) / Length(sum)));
      }
      return found->second;
    };
    std::vector<Triangle> parts;
    for (const auto & [a, b, c] : triangles)
    {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      parts.insert(parts.end(), { { a, ab, ca }, { b, bc, ab }, { c, ca, bc }, { ab, bc, ca } });
    }
    triangles = parts;
  }
  auto surface = itk::TriangleSurface::New();
  const double scale = radius / std::sqrt(3.0);
  for (const Vector3 & p : points)
  {
    surface->GetPoints().push_back(itk::ToPoint(Along(center, p, scale)));
  }
  surface->GetTriangles().assign(triangles.begin(), triangles.end());
  return surface;
}

} // namespace rhombic
