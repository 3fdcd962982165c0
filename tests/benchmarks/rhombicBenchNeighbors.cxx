#include "rhombicBenchSections.h"

#include "itkConstNeighborhoodIterator.h"
#include "itkFCCConstNeighborhoodIterator.h"

#include <algorithm>

namespace rhombic
{
namespace
{

using VolumeType = itk::Image<std::int16_t, 3>;
using LatticeType = itk::FCCImage<std::int16_t>;
using RegionType = itk::ImageRegion<3>;

/** A lattice with the same samples in the same order. */
LatticeType::Pointer
AsLattice(const VolumeType * volume)
{
  auto lattice = LatticeType::New();
  lattice->SetRegions(volume->GetBufferedRegion());
  lattice->Allocate();
  std::copy_n(volume->GetBufferPointer(), volume->GetBufferedRegion().GetNumberOfPixels(), lattice->GetBufferPointer());
  return lattice;
}

/** For each sample, the sum of the differences to its neighbours, with an iterator of the lattice or of the grid.
 * \param get reads neighbour n */
template <typename TIterator, typename TGet>
std::vector<int>
SumDifferences(TIterator it, itk::SizeValueType samples, const TGet & get)
{
  std::vector<int> sums;
  sums.reserve(samples);
  const auto neighbors = static_cast<unsigned int>(it.Size());
  for (; !it.IsAtEnd(); ++it)
  {
    int sum = 0;
    for (unsigned int n = 0; n < neighbors; ++n)
    {
      sum += get(it, n);
    }
    sums.push_back(sum - static_cast<int>(neighbors) * it.GetCenterPixel());
  }
  return sums;
}

std::vector<int>
SumOnLattice(const LatticeType * lattice, const RegionType & region)
{
  return SumDifferences(itk::FCCConstNeighborhoodIterator<LatticeType>(lattice, region),
                        region.GetNumberOfPixels(),
                        [](const auto & it, unsigned int n) { return it.GetNeighbor(n); });
}

std::vector<int>
SumOnGrid(const VolumeType * volume, const RegionType & region)
{
  return SumDifferences(itk::ConstNeighborhoodIterator<VolumeType>({ { 1, 1, 1 } }, volume, region),
                        region.GetNumberOfPixels(),
                        [](const auto & it, unsigned int n) { return it.GetPixel(n); });
}

/** The same with a hand-written loop, for a region whose neighbours are all in the image. */
std::vector<int>
SumByHand(const LatticeType * lattice, const RegionType & region)
{
  std::vector<int> sums;
  sums.reserve(region.GetNumberOfPixels());
  const itk::OffsetValueType * const table = lattice->GetOffsetTable();
  std::array<std::array<itk::OffsetValueType, 12>, 2> steps{};
  for (unsigned int parity = 0; parity < 2; ++parity)
  {
    for (unsigned int n = 0; n < 12; ++n)
    {
      const auto offset = itk::FCCLattice::OffsetOf(itk::FCCLattice::NearestNeighbors[n], parity);
      steps[parity][n] = offset[0] + offset[1] * table[1] + offset[2] * table[2];
    }
  }
  const auto end = region.GetIndex() + region.GetSize();
  for (itk::IndexValueType k = region.GetIndex(2); k < end[2]; ++k)
  {
    for (itk::IndexValueType j = region.GetIndex(1); j < end[1]; ++j)
    {
      const auto & ofRow = steps[static_cast<unsigned int>(itk::FCCLattice::Parity(j, k))];
      const std::int16_t * sample = &lattice->GetPixel({ { region.GetIndex(0), j, k } });
      for (itk::SizeValueType i = 0; i < region.GetSize(0); ++i, ++sample)
      {
        int sum = 0;
        for (const auto step : ofRow)
        {
          sum += sample[step];
        }
        sums.push_back(sum - 12 * *sample);
      }
    }
  }
  return sums;
}

} // namespace

std::vector<BenchResult>
MeasureNeighbors(const BenchInput & input, const BenchSettings & settings)
{
  const LatticeType::Pointer lattice = AsLattice(input.volume);
  const RegionType whole = lattice->GetBufferedRegion();
  RegionType interior = whole;
  interior.ShrinkByRadius(1);
  const auto result = [&](const char * candidate, const char * reference, const PairedTimes & times) {
    return BenchResult{ "neighbors", candidate, reference, 1, times, std::nullopt, {} };
  };
  const auto grid = [&] { return SumOnGrid(input.volume, whole); };
  return { result("FCC iterator, 12 neighbours",
                  "ConstNeighborhoodIterator, 3x3x3",
                  TimePairs(settings.repeats, grid, [&] { return SumOnLattice(lattice, whole); })),
           result("FCC iterator, interior",
                  "loop by hand, interior",
                  TimePairs(
                    settings.repeats,
                    [&] { return SumByHand(lattice, interior); },
                    [&] { return SumOnLattice(lattice, interior); })) };
}

} // namespace rhombic
