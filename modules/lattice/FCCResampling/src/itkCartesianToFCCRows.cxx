#include "detail/itkCartesianToFCCRows.h"

#include "itkSlicePlacement.h"

namespace itk
{

CartesianToFCCRows::CartesianToFCCRows(const ImageBase<3> & volume,
                                       const ImageBase<3> & lattice,
                                       SeparableKernel kernel,
                                       const SliceOriginsType & sliceOrigins)
  : m_Volume(volume)
  , m_Lattice(lattice)
  , m_Kernel(kernel)
{
  if (!sliceOrigins.empty() || !AreAxesPerpendicular(volume.GetDirection()))
  {
    m_Stack.emplace(volume, sliceOrigins);
  }
}

SeparableTaps
CartesianToFCCRows::MakeTaps(unsigned int axis, const RegionType & sites, IndexValueType parity) const
{
  // The lattice's axes are the volume's: along each, positions depend on one lattice coordinate alone.
  const auto first = m_Volume.TransformPhysicalPointToContinuousIndex<double>(m_Lattice.GetOrigin());
  const double start = first[axis] - static_cast<double>(m_Volume.GetLargestPossibleRegion().GetIndex(axis));
  const double step = m_Lattice.GetSpacing()[axis] / m_Volume.GetSpacing()[axis];

  std::vector<double> positions(sites.GetSize(axis));
  for (SizeValueType n = 0; n < positions.size(); ++n)
  {
    const auto index = sites.GetIndex(axis) + static_cast<IndexValueType>(n);
    positions[n] = start + step * static_cast<double>(axis == 0 ? 2 * index + parity : index);
  }
  return SeparableTaps(m_Kernel, m_Volume.GetLargestPossibleRegion().GetSize(axis), positions);
}

SliceStackPlanes
CartesianToFCCRows::MakePlanes(const RegionType & sites) const
{
  return SliceStackPlanes(*m_Stack,
                          m_Kernel,
                          m_Volume.GetLargestPossibleRegion().GetSize(),
                          m_Stack->TransformPointToFrame(m_Lattice.GetOrigin()),
                          m_Lattice.GetSpacing(),
                          sites);
}

CartesianToFCCRows::RegionType
CartesianToFCCRows::FindNeededSamples(const RegionType & sites) const
{
  RegionType needed;
  if (m_Stack)
  {
    needed = this->MakePlanes(sites).FindNeededSamples();
  }
  for (unsigned int axis = 0; axis < 3 && !m_Stack; ++axis)
  {
    const SeparableTaps even = this->MakeTaps(axis, sites, 0);
    const SeparableTaps odd = this->MakeTaps(axis, sites, 1); // the same as even, but along x
    const SizeValueType first = even.GetFirst(0);
    const SizeValueType last = odd.GetFirst(sites.GetSize(axis) - 1) + odd.GetNumberOfTaps();
    needed.SetIndex(axis, static_cast<IndexValueType>(first));
    needed.SetSize(axis, last - first);
  }
  const Index<3> & begin = m_Volume.GetLargestPossibleRegion().GetIndex();
  needed.SetIndex(needed.GetIndex() + (begin - Index<3>{ { 0, 0, 0 } }));
  return needed;
}

void
CartesianToFCCRows::Resample(const RegionType & sites, const LoadRow & load, const StoreRow & store) const
{
  const Offset<3> begin = m_Volume.GetLargestPossibleRegion().GetIndex() - Index<3>{ { 0, 0, 0 } };
  const LoadRow loadFromVolume = [&load, &begin](const Index<3> & start, SizeValueType length, float * row) {
    load(start + begin, length, row);
  };
  if (m_Stack)
  {
    ResampleStackRows(this->MakePlanes(sites), sites, loadFromVolume, store);
  }
  else
  {
    const SeparableTaps xTaps[2] = { this->MakeTaps(0, sites, 0), this->MakeTaps(0, sites, 1) };
    ResampleRows(xTaps, this->MakeTaps(1, sites), this->MakeTaps(2, sites), sites, loadFromVolume, store);
  }
}

} // namespace itk
