#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCIsosurfaceFilter.h"
#include "itkTriangleSurfaceMeasures.h"
#include "itkTriangleSurfaceTopology.h"

#include "itkImageRegionIteratorWithIndex.h"

#include <cmath>
#include <iostream>

/** A ball of radius 10 mm onto the lattice; its surface must be closed and of the ball's volume. */
int
main()
{
  using ImageType = itk::Image<float, 3>;
  const auto image = ImageType::New();
  image->SetRegions(ImageType::SizeType{ { 32, 32, 32 } });
  image->Allocate();
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd(); ++it)
  {
    const auto & index = it.GetIndex();
    it.Set(10.0f - static_cast<float>(std::hypot(index[0] - 15.3, index[1] - 15.1, index[2] - 15.7)));
  }
  const auto lattice = itk::CartesianToFCCImageFilter<ImageType>::New();
  lattice->SetInput(image);
  const auto surface = itk::FCCIsosurfaceFilter<itk::FCCImage<float>>::New();
  surface->SetInput(lattice->GetOutput());
  surface->Update();

  const double exact = 4000.0 / 3.0 * std::acos(-1.0);
  const double volume = ComputeTriangleSurfaceVolume(*surface->GetOutput());
  std::cout << surface->GetOutput()->GetNumberOfTriangles() << " triangles, " << volume << " mm^3, exactly " << exact
            << '\n';
  const bool isGood =
    ComputeTriangleSurfaceTopology(*surface->GetOutput()).IsWatertight() && std::abs(volume / exact - 1.0) < 0.005;
  return isGood ? 0 : 1;
}
