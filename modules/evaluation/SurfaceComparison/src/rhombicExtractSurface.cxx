#include "rhombicExtractSurface.h"

#include "itkFCCIsosurfaceFilter.h"

namespace rhombic
{

const std::vector<ExtractionMode> &
GetExtractionModes()
{
  static const std::vector<ExtractionMode> modes{ ExtractionMode::Tetrahedra,
                                                  ExtractionMode::Octahedra,
                                                  ExtractionMode::Parallelepipeds,
                                                  ExtractionMode::Fine,
                                                  ExtractionMode::Lean };
  return modes;
}

const char *
NameOf(ExtractionMode mode)
{
  switch (mode)
  {
    case ExtractionMode::Tetrahedra:
      return "tetrahedra";
    case ExtractionMode::Octahedra:
      return "octahedra";
    case ExtractionMode::Parallelepipeds:
      return "parallelepipeds";
    case ExtractionMode::Fine:
      return "fine";
    case ExtractionMode::Lean:
      return "lean";
  }
  return "";
}

template <typename TPixel>
itk::TriangleSurface::Pointer
ExtractSurface(const itk::FCCImage<TPixel> * image, double isovalue, ExtractionMode mode, bool normals, bool closed)
{
  const auto filter = itk::FCCIsosurfaceFilter<itk::FCCImage<TPixel>>::New();
  filter->SetInput(image);
  filter->SetMode(mode);
  filter->SetComputeNormals(normals);
  filter->SetIsovalue(isovalue);
  filter->SetClosed(closed);
  filter->Update();
  return filter->GetOutput();
}

template itk::TriangleSurface::Pointer
ExtractSurface<std::int16_t>(const itk::FCCImage<std::int16_t> *, double, ExtractionMode, bool, bool);
template itk::TriangleSurface::Pointer
ExtractSurface<float>(const itk::FCCImage<float> *, double, ExtractionMode, bool, bool);

} // namespace rhombic
