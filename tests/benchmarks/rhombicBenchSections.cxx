#include "rhombicBenchSections.h"

#include "rhombicExtractSurface.h"
#include "rhombicProcessMemory.h"

#include "itkBSplineInterpolateImageFunction.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkLinearInterpolateImageFunction.h"
#include "itkMultiThreaderBase.h"
#include "itkResampleImageFilter.h"
#include "itkWindowedSincInterpolateImageFunction.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <numeric>

namespace rhombic
{
namespace
{

using VolumeType = itk::Image<std::int16_t, 3>;
using LatticeType = itk::FCCImage<std::int16_t>;

constexpr double mebibyte = 1024.0 * 1024.0;

LatticeType::Pointer
Resample(const BenchInput & input, itk::SeparableKernel kernel)
{
  const auto filter = itk::CartesianToFCCImageFilter<VolumeType>::New();
  filter->SetInput(input.volume);
  filter->SetDensity(input.density);
  filter->SetKernel(kernel);
  filter->Update();
  return filter->GetOutput();
}

/** Resamples to the same lattice with itk::ResampleImageFilter. */
template <typename TInterpolator>
LatticeType::Pointer
ResampleWithITK(const BenchInput & input, const LatticeType * lattice)
{
  const auto filter = itk::ResampleImageFilter<VolumeType, LatticeType>::New();
  filter->SetInput(input.volume);
  const auto interpolator = TInterpolator::New();
  filter->SetInterpolator(interpolator);
  filter->SetSize(lattice->GetLargestPossibleRegion().GetSize());
  filter->SetOutputStartIndex(lattice->GetLargestPossibleRegion().GetIndex());
  filter->SetOutputSpacing(lattice->GetSpacing());
  filter->SetOutputOrigin(lattice->GetOrigin());
  filter->SetOutputDirection(lattice->GetDirection());
  filter->Update();
  return filter->GetOutput();
}

/** The largest difference of two results at every 1009th site, of those that lie between samples of the volume. */
int
LargestDifference(const BenchInput & input, const LatticeType * a, const LatticeType * b)
{
  int largest = 0;
  const auto & size = input.volume->GetBufferedRegion().GetSize();
  const auto count = a->GetBufferedRegion().GetNumberOfPixels();
  for (itk::SizeValueType i = 0; i < count; i += 1009)
  {
    const auto offset = static_cast<itk::OffsetValueType>(i);
    const auto point = a->TransformIndexToPhysicalPoint<double>(a->ComputeIndex(offset));
    const auto index = input.volume->TransformPhysicalPointToContinuousIndex<double>(point);
    bool isInside = true;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      isInside = isInside && index[axis] >= 0.0 && index[axis] <= static_cast<double>(size[axis] - 1);
    }
    if (isInside)
    {
      largest = std::max(largest, std::abs(a->GetBufferPointer()[offset] - b->GetBufferPointer()[offset]));
    }
  }
  return largest;
}

/** The ratio to vtkFlyingEdges3D that a mode must reach. */
std::optional<double>
TargetOf(ExtractionMode mode, bool normals, bool isScan)
{
  switch (mode)
  {
    case ExtractionMode::Tetrahedra:
      return normals ? 1.0 : 1.5;
    case ExtractionMode::Fine:
      return normals ? std::optional<double>(1.0) : std::nullopt;
    case ExtractionMode::Lean:
      return normals ? std::optional<double>(isScan ? 0.5 : 1.0) : std::nullopt; // of noisy scans many sites are split
    default:
      return std::nullopt;
  }
}

std::string
WithNormals(const std::string & name, bool normals)
{
  return name + (normals ? ", normals" : ", no normals");
}

double
MeshMemory(vtkPolyData * mesh)
{
  // GetActualMemorySize() is in KiB; points and cells only, where the filter put its output.
  return static_cast<double>(mesh->GetActualMemorySize()) / 1024.0;
}

/** Reads every sample, on all threads. The sum keeps the compiler from skipping that. */
double
SumOf(const LatticeType * lattice)
{
  const auto threader = itk::MultiThreaderBase::New();
  const auto & size = lattice->GetBufferedRegion().GetSize();
  const auto plane = size[0] * size[1];
  std::vector<double> sums(size[2]);
  threader->ParallelizeArray(
    0,
    size[2],
    [&](itk::SizeValueType k) {
      const std::int16_t * const begin = lattice->GetBufferPointer() + k * plane;
      sums[k] = static_cast<double>(std::accumulate(begin, begin + plane, std::int64_t{ 0 }));
    },
    nullptr);
  return std::accumulate(sums.begin(), sums.end(), 0.0);
}

/** Copies the arrays of a surface to new memory, on all threads. */
std::unique_ptr<char[]>
CopyOf(const itk::TriangleSurface * surface)
{
  struct Part
  {
    const void * data;
    std::size_t size;
  };
  const Part parts[] = { { surface->GetPoints().data(), surface->GetPoints().size() * 12 },
                         { surface->GetNormals().data(), surface->GetNormals().size() * 12 },
                         { surface->GetTriangles().data(), surface->GetTriangles().size() * 12 } };
  std::unique_ptr<char[]> copy(new char[surface->GetMemorySize()]);
  char * target = copy.get();
  const auto threader = itk::MultiThreaderBase::New();
  for (const Part & part : parts)
  {
    constexpr std::size_t block = 1U << 20U;
    threader->ParallelizeArray(
      0,
      (part.size + block - 1) / block,
      [&](itk::SizeValueType i) {
        std::memcpy(
          target + i * block, static_cast<const char *>(part.data) + i * block, std::min(block, part.size - i * block));
      },
      nullptr);
    target += part.size;
  }
  return copy;
}

} // namespace

std::vector<BenchResult>
MeasureExtraction(const BenchInput & input, const BenchSettings & settings)
{
  std::vector<BenchResult> results;
  const auto lattice = Resample(input, itk::SeparableKernel::CubicBSpline);
  const auto volume = ShareWithVTK(input.volume.GetPointer());
  for (const VTKExtractor extractor : { VTKExtractor::FlyingEdges, VTKExtractor::MarchingCubes })
  {
    const bool isTarget = extractor == VTKExtractor::FlyingEdges;
    const char * const name = isTarget ? "vtkFlyingEdges3D" : "vtkMarchingCubes";
    const auto repeats = isTarget ? settings.repeats : settings.slowRepeats;
    for (const bool normals : { true, false })
    {
      const auto reference = ExtractWithVTK(extractor, volume, input.isovalue, normals);
      for (const ExtractionMode mode : ExtractionModes)
      {
        const auto surface = ExtractSurface(lattice.GetPointer(), input.isovalue, mode, normals);
        BenchResult result;
        result.section = "extraction";
        result.candidate = WithNormals(NameOf(mode), surface->HasNormals());
        result.reference = WithNormals(name, normals);
        result.threads = settings.threads;
        result.times = TimePairs(
          repeats,
          [&] { return ExtractWithVTK(extractor, volume, input.isovalue, normals); },
          [&] { return ExtractSurface(lattice.GetPointer(), input.isovalue, mode, normals); });
        result.target = isTarget ? TargetOf(mode, normals, input.isScan) : std::nullopt;
        result.details = { { "triangles", surface->GetNumberOfTriangles() },
                           { "points", surface->GetNumberOfPoints() },
                           { "reference_triangles", reference->GetNumberOfPolys() },
                           { "reference_points", reference->GetNumberOfPoints() } };
        results.push_back(result);
      }
    }
  }
  return results;
}

std::vector<BenchResult>
MeasureResampling(const BenchInput & input, const BenchSettings & settings)
{
  using Reference = std::function<LatticeType::Pointer(const LatticeType *)>;
  struct Kernel
  {
    itk::SeparableKernel kernel;
    const char * name;
    const char * referenceName;
    Reference reference;
    std::optional<double> target;
    bool isSlow;
  };
  using LinearType = itk::LinearInterpolateImageFunction<VolumeType, double>;
  using CubicType = itk::BSplineInterpolateImageFunction<VolumeType, double, double>; // its default order is 3
  using LanczosType = itk::WindowedSincInterpolateImageFunction<VolumeType, 4, itk::Function::LanczosWindowFunction<4>>;
  const Kernel kernels[] = { { itk::SeparableKernel::Linear,
                               "linear",
                               "itk::ResampleImageFilter, linear",
                               [&](const LatticeType * lattice) { return ResampleWithITK<LinearType>(input, lattice); },
                               8.0,
                               false },
                             { itk::SeparableKernel::CubicBSpline,
                               "cubic B-spline",
                               "itk::ResampleImageFilter, cubic B-spline",
                               [&](const LatticeType * lattice) { return ResampleWithITK<CubicType>(input, lattice); },
                               20.0,
                               true },
                             { itk::SeparableKernel::Lanczos4,
                               "Lanczos",
                               "itk::ResampleImageFilter, windowed sinc",
                               [&](const LatticeType * lattice) {
                                 return ResampleWithITK<LanczosType>(input, lattice);
                               },
                               std::nullopt,
                               true } };

  std::vector<BenchResult> results;
  for (const Kernel & kernel : kernels)
  {
    const auto lattice = Resample(input, kernel.kernel);
    LatticeType::Pointer last;
    BenchResult result;
    result.section = "resampling";
    result.candidate = kernel.name;
    result.reference = kernel.referenceName;
    result.threads = settings.threads;
    result.times = TimePairs(
      kernel.isSlow ? settings.slowRepeats : settings.repeats,
      [&] {
        last = nullptr;
        last = kernel.reference(lattice);
        return 0;
      },
      [&] { return Resample(input, kernel.kernel); });
    result.target = kernel.target;
    result.details = { { "sites", lattice->GetLargestPossibleRegion().GetNumberOfPixels() },
                       { "largest_difference", LargestDifference(input, lattice, last) } };
    results.push_back(result);
  }
  return results;
}

std::vector<BenchResult>
MeasurePipeline(const BenchInput & input, const BenchSettings & settings)
{
  std::vector<BenchResult> results;
  const auto volume = ShareWithVTK(input.volume.GetPointer());
  for (const ExtractionMode mode : ExtractionModes)
  {
    const auto work = [&] {
      const auto lattice = Resample(input, itk::SeparableKernel::CubicBSpline);
      return ExtractSurface(lattice.GetPointer(), input.isovalue, mode, true);
    };
    BenchResult result;
    result.section = "pipeline";
    result.candidate = WithNormals("cubic B-spline + " + NameOf(mode), true);
    result.reference = "vtkFlyingEdges3D, normals";
    result.threads = settings.threads;
    result.times = TimePairs(
      settings.repeats, [&] { return ExtractWithVTK(VTKExtractor::FlyingEdges, volume, input.isovalue, true); }, work);
    result.target = NameOf(mode) == "lean" ? std::optional<double>(1.0) : std::nullopt;
    results.push_back(result);
  }
  return results;
}

std::vector<BenchResult>
MeasureFloor(const BenchInput & input, const BenchSettings & settings)
{
  std::vector<BenchResult> results;
  const auto lattice = Resample(input, itk::SeparableKernel::CubicBSpline);
  for (const ExtractionMode mode : ExtractionModes)
  {
    const auto surface = ExtractSurface(lattice.GetPointer(), input.isovalue, mode, true);
    volatile double sum = 0.0;
    BenchResult result;
    result.section = "floor";
    result.candidate = WithNormals(NameOf(mode), surface->HasNormals());
    result.reference = "read the samples, write the mesh";
    result.threads = settings.threads;
    result.times = TimePairs(
      settings.repeats,
      [&] {
        sum = SumOf(lattice);
        return CopyOf(surface);
      },
      [&] { return ExtractSurface(lattice.GetPointer(), input.isovalue, mode, true); });
    result.details = { { "megabytes_read", static_cast<double>(lattice->GetPixelContainer()->Size()) * 2e-6 },
                       { "megabytes_written", static_cast<double>(surface->GetMemorySize()) * 1e-6 } };
    results.push_back(result);
  }
  return results;
}

std::vector<MemoryResult>
MeasureMemory(const BenchInput & input, const BenchSettings & settings)
{
  std::vector<MemoryResult> results;
  const auto measure = [&](const std::string & candidate, double volume, const auto & work, const auto & memoryOf) {
    work(); // so that memory which libraries allocate once is not counted
    if (!ResetPeakMemory())
    {
      return;
    }
    const double before = GetProcessMemory().now;
    const auto mesh = work();
    MemoryResult result;
    result.candidate = candidate;
    result.threads = settings.threads;
    result.volume = volume;
    result.mesh = memoryOf(mesh);
    result.extra = GetProcessMemory().peak - before - result.mesh;
    results.push_back(result);
  };

  const auto volume = ShareWithVTK(input.volume.GetPointer());
  measure(
    "vtkFlyingEdges3D, normals",
    static_cast<double>(input.volume->GetPixelContainer()->Size()) * sizeof(std::int16_t) / mebibyte,
    [&] { return ExtractWithVTK(VTKExtractor::FlyingEdges, volume, input.isovalue, true); },
    [](const auto & mesh) { return MeshMemory(mesh); });

  const auto lattice = Resample(input, itk::SeparableKernel::CubicBSpline);
  for (const ExtractionMode mode : ExtractionModes)
  {
    measure(
      WithNormals(NameOf(mode), true),
      static_cast<double>(lattice->GetPixelContainer()->Size()) * sizeof(std::int16_t) / mebibyte,
      [&] { return ExtractSurface(lattice.GetPointer(), input.isovalue, mode, true); },
      [](const auto & mesh) { return static_cast<double>(mesh->GetMemorySize()) / mebibyte; });
  }
  return results;
}

} // namespace rhombic
