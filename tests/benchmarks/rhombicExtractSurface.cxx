#include "rhombicExtractSurface.h"

#include "itkFCCIsosurfaceFilter.h"

namespace rhombic
{

const std::vector<ExtractionMode> &
GetExtractionModes()
{
  static const std::vector<ExtractionMode> modes{ ExtractionMode::Tetrahedra };
  return modes;
}

const char *
NameOf(ExtractionMode mode)
{
  switch (mode)
  {
    case ExtractionMode::Tetrahedra:
      return "tetrahedra";
  }
  return "";
}

template <typename TPixel>
itk::TriangleSurface::Pointer
ExtractSurface(const itk::FCCImage<TPixel> * image,
               double isovalue,
               [[maybe_unused]] ExtractionMode mode,
               [[maybe_unused]] bool normals,
               bool closed)
{
  const auto filter = itk::FCCIsosurfaceFilter<itk::FCCImage<TPixel>>::New();
  filter->SetInput(image);
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
