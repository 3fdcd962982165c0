// How well two surfaces agree, by a filter of ITK's kind: surfaces from files of any program.

#include "exampleInput.h"
#include "itkTriangleSurfaceAgreementFilter.h"
#include "rhombicSurfaceIO.h"

#include <iostream>

int
main(int argc, char ** argv)
try
{
  if (argc != 4)
  {
    throw std::runtime_error("usage: HowFarApart FIRST.stl SECOND.stl TOLERANCE");
  }
  const auto filter = itk::TriangleSurfaceAgreementFilter::New();
  filter->SetTolerance(example::ParseNumber("TOLERANCE", argv[3], 0.0));
  const auto readOne = [](const char * path) {
    const std::vector<rhombic::SceneSurface> surfaces = rhombic::ReadSurfaces(path);
    if (surfaces.size() != 1)
    {
      throw std::runtime_error(std::string(path) + " holds " + std::to_string(surfaces.size()) +
                               " surfaces; name a file of one");
    }
    return surfaces.front().surface;
  };
  const itk::TriangleSurface::ConstPointer first = readOne(argv[1]);
  const itk::TriangleSurface::ConstPointer second = readOne(argv[2]);
  filter->SetInput1(first);
  filter->SetInput2(second);
  filter->Update();
  const itk::TriangleSurfaceAgreement & agreement = filter->GetAgreement();
  const bool isOfFirst = agreement.worstSide == itk::TriangleSurfaceAgreement::Side::First;
  std::cout << "Hausdorff distance: " << agreement.hausdorff << " mm\n"
            << "95 % of both surfaces within: " << agreement.hausdorff95 << " mm\n"
            << "mean distance: " << agreement.meanOfMeans << " mm\n"
            << "normalised surface Dice: " << agreement.normalizedDice << '\n'
            << "farthest apart: " << agreement.worst[0] << ' ' << agreement.worst[1] << ' ' << agreement.worst[2]
            << " mm, where the " << (isOfFirst ? "first" : "second") << " alone is\n";
}
catch (const std::exception & error)
{
  return example::Report(error);
}
