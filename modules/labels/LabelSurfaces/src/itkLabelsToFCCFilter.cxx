#include "itkLabelsToFCCFilter.h"

#include "detail/itkCartesianToFCCRows.h"
#include "itkAntiAliasMaskImageFilter.h"
#include "itkBoundingBox.h"
#include "itkBulkImage.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkInputSamples.h"
#include "itkKeepLabelVolumes.h"
#include "itkLabelBlocks.h"
#include "itkLabelTopology.h"
#include "itkLabelsOnLattice.h"
#include "itkMath.h"
#include "itkWorkProgress.h"
#include "rhombicLabelNumbers.h"
#include "rhombicVoxelGrid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

/** \file
 * Words. The *refined map* has the map's voxels divided into nearly cubic ones; its *samples* are the centres of the
 * map's voxels. The *field* of a label is the depth below its surface in refined voxels; its values at sites are the
 * label's *weights*. The *candidates* of a label are the sites that its thin parts pass. */

namespace itk
{
namespace
{

using LabelType = LabelsToFCCFilter::LabelType;
using LabelImage = LabelsToFCCFilter::InputImageType;
using Lattice = LabelsToFCCFilter::LatticeType;
using SliceOrigins = LabelsToFCCFilter::SliceOriginsType;
using MaskImage = Image<std::uint8_t, 3>;
using FieldImage = Image<float, 3>;
using FieldLattice = FCCImage<float>;

constexpr IndexValueType Margin = 2;      // voxels around the map
constexpr IndexValueType LabelMargin = 4; // voxels around a label in which it has weights
constexpr double LabelReach = 6.25;       // voxels within which labels have an effect on fields, times the widening

/** The map refined to nearly cubic voxels. A sample has an index that is a multiple of the period along each axis. */
class RefinedMap
{
public:
  RefinedMap(const LabelImage & labels, const SliceOrigins & origins)
    : m_Labels(labels)
    , m_Period(DivideVoxels(labels.GetSpacing()))
    , m_Grid(FieldImage::New())
  {
    const auto & size = labels.GetLargestPossibleRegion().GetSize();
    auto spacing = labels.GetSpacing();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_MapRegion.SetIndex(axis, -static_cast<IndexValueType>(m_Period[axis] / 2));
      m_MapRegion.SetSize(axis, (size[axis] - 1) * m_Period[axis] + 1 + 2 * (m_Period[axis] / 2));
      spacing[axis] /= static_cast<double>(m_Period[axis]);
    }
    ImageRegion<3> whole = m_MapRegion;
    whole.PadByRadius(Margin);
    m_Grid->SetLargestPossibleRegion(whole);
    m_Grid->SetSpacing(spacing);
    m_Grid->SetDirection(labels.GetDirection());
    m_Grid->SetOrigin(labels.TransformIndexToPhysicalPoint<double>(labels.GetLargestPossibleRegion().GetIndex()));
    this->PlaceSlices(origins);
  }

  const std::array<SizeValueType, 3> &
  GetPeriod() const
  {
    return m_Period;
  }

  /** The refined grid with a margin around the map, without voxels in memory. */
  const FieldImage &
  GetGrid() const
  {
    return *m_Grid;
  }

  /** The voxels of the grid that are the map's. */
  const ImageRegion<3> &
  GetMapRegion() const
  {
    return m_MapRegion;
  }

  /** Positions of the first voxels of the grid's slices; empty for slices at even steps. */
  const SliceOrigins &
  GetSliceOrigins() const
  {
    return m_SliceOrigins;
  }

  /** The position of a voxel's centre in the world. */
  Point<double, 3>
  GetPosition(const Index<3> & index) const
  {
    const Index<3> & first = m_Grid->GetLargestPossibleRegion().GetIndex();
    if (m_SliceOrigins.empty())
    {
      return m_Grid->TransformIndexToPhysicalPoint<double>(index);
    }
    const Index<3> inFirstSlice{ { index[0], index[1], first[2] } };
    return m_Grid->TransformIndexToPhysicalPoint<double>(inFirstSlice) +
           (m_SliceOrigins[static_cast<std::size_t>(index[2] - first[2])] -
            m_Grid->TransformIndexToPhysicalPoint<double>(first));
  }

  /** The index along an axis of the nearest voxel of the map, from its first; beyond the map of that at its border. */
  SizeValueType
  GetNearest(unsigned int axis, IndexValueType index) const
  {
    const IndexValueType last = m_MapRegion.GetUpperIndex()[axis];
    const IndexValueType inMap = std::clamp(index, m_MapRegion.GetIndex(axis), last) - m_MapRegion.GetIndex(axis);
    return std::min(static_cast<SizeValueType>(inMap) / m_Period[axis],
                    m_Labels.GetLargestPossibleRegion().GetSize(axis) - 1);
  }

  /** The row of the map nearest to a row of the refined map. */
  const LabelType *
  GetNearestRow(const Index<3> & index) const
  {
    const auto & size = m_Labels.GetLargestPossibleRegion().GetSize();
    return m_Labels.GetBufferPointer() +
           (this->GetNearest(2, index[2]) * size[1] + this->GetNearest(1, index[1])) * size[0];
  }

  /** Whether the voxel of the map nearest to a point in the world, beyond the map that at its border, is background. */
  bool
  IsBackground(Point<double, 3> point) const
  {
    if (!m_SliceOrigins.empty())
    {
      Index<3> first = m_Grid->GetLargestPossibleRegion().GetIndex();
      const std::size_t slice = this->FindSlice(point);
      first[2] += static_cast<IndexValueType>(slice);
      point -= m_SliceOrigins[slice] - m_Grid->TransformIndexToPhysicalPoint<double>(first);
    }
    const Index<3> voxel = m_Grid->TransformPhysicalPointToIndex(point);
    return this->GetNearestRow(voxel)[this->GetNearest(0, voxel[0])] == 0;
  }

  /** Depth along one axis below the outer faces of the map, negative beyond it. */
  float
  GetDepth(unsigned int axis, IndexValueType index) const
  {
    const double outer = 0.5 * static_cast<double>(m_Period[axis]);
    const auto last = static_cast<double>((m_Labels.GetLargestPossibleRegion().GetSize(axis) - 1) * m_Period[axis]);
    const auto position = static_cast<double>(index);
    return static_cast<float>(std::min(position + outer, last + outer - position));
  }

private:
  /** Positions of the first voxels of the refined slices, from the slices of the map and with the margin. */
  void
  PlaceSlices(const SliceOrigins & origins)
  {
    if (origins.size() < 2)
    {
      return;
    }
    const ImageRegion<3> & whole = m_Grid->GetLargestPossibleRegion();
    Vector<double, 3> toFirst(0.0);
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      toFirst[axis] =
        static_cast<double>(whole.GetIndex(axis)) / static_cast<double>(m_Period[axis]) * m_Labels.GetSpacing()[axis];
    }
    toFirst = m_Labels.GetDirection() * toFirst;
    for (IndexValueType k = whole.GetIndex(2); k <= whole.GetUpperIndex()[2]; ++k)
    {
      const double position = static_cast<double>(k) / static_cast<double>(m_Period[2]);
      const auto slice =
        static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, static_cast<double>(origins.size() - 2)));
      const double share = position - static_cast<double>(slice);
      m_SliceOrigins.push_back(origins[slice] + (origins[slice + 1] - origins[slice]) * share + toFirst);
    }
    const auto axis = [this](unsigned int column) {
      return Vector<double, 3>(m_Labels.GetDirection().GetVnlMatrix().get_column(column).data_block());
    };
    m_Normal = CrossProduct(axis(0), axis(1));
    m_Normal *= m_Normal * (m_SliceOrigins.back() - m_SliceOrigins.front()) < 0.0 ? -1.0 : 1.0;
    for (const auto & origin : m_SliceOrigins)
    {
      m_Heights.push_back((origin - m_SliceOrigins.front()) * m_Normal);
    }
  }

  /** The refined slice nearest to a point. */
  std::size_t
  FindSlice(const Point<double, 3> & point) const
  {
    const double height = (point - m_SliceOrigins.front()) * m_Normal;
    const auto after = std::lower_bound(m_Heights.begin() + 1, m_Heights.end() - 1, height);
    const auto nearest = height - *(after - 1) < *after - height ? after - 1 : after;
    return static_cast<std::size_t>(nearest - m_Heights.begin());
  }

  const LabelImage & m_Labels;
  std::array<SizeValueType, 3> m_Period;
  ImageRegion<3> m_MapRegion;
  FieldImage::Pointer m_Grid;
  SliceOrigins m_SliceOrigins;
  Vector<double, 3> m_Normal;    ///< of slices at uneven steps, in their order
  std::vector<double> m_Heights; ///< of the origins along the normal
};

// ---- Passes, in the order of their use

/** Makes the lattice of a refined map, without samples. Between slices that are refined to four voxels or more, fields
 * are as smooth as the slices allow: there sites are twice as far apart along the refined axis. */
FieldLattice::Pointer
MakeLattice(const RefinedMap & map, double density)
{
  const auto filter = CartesianToFCCImageFilter<FieldImage>::New();
  filter->SetInput(&map.GetGrid());
  auto spacing = map.GetGrid().GetSpacing();
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double stretch = std::clamp(0.5 * static_cast<double>(map.GetPeriod()[axis]), 1.0, 2.0);
    spacing[axis] *= stretch / std::cbrt(2.0 * density); // a site has the volume of two cubes of the spacing's edge
  }
  filter->SetOutputSpacing(spacing);
  filter->SetSliceOrigins(map.GetSliceOrigins());
  filter->UpdateOutputInformation();
  FieldLattice::Pointer lattice = filter->GetOutput();
  lattice->DisconnectPipeline();
  return lattice;
}

/** Finds the bounding box of each label of the map with a margin, in refined voxels; for 0 the box of all others. */
std::map<LabelType, ImageRegion<3>>
FindBoxes(const LabelImage & labels, const RefinedMap & map)
{
  std::map<LabelType, std::pair<Index<3>, Index<3>>> corners;
  const auto & size = labels.GetLargestPossibleRegion().GetSize();
  for (SizeValueType row = 0; row < size[1] * size[2]; ++row)
  {
    const LabelType * const voxels = labels.GetBufferPointer() + row * size[0];
    const auto y = static_cast<IndexValueType>(row % size[1]);
    const auto z = static_cast<IndexValueType>(row / size[1]);
    rhombic::ForEachRun(voxels, size[0], [&](LabelType label, SizeValueType begin, SizeValueType end) {
      if (label == 0)
      {
        return;
      }
      const Index<3> first{ { static_cast<IndexValueType>(begin), y, z } };
      const Index<3> last{ { static_cast<IndexValueType>(end) - 1, y, z } };
      for (const LabelType each : { label, LabelType{ 0 } })
      {
        auto & [low, high] = corners.try_emplace(each, first, last).first->second;
        for (unsigned int axis = 0; axis < 3; ++axis)
        {
          low[axis] = std::min(low[axis], first[axis]);
          high[axis] = std::max(high[axis], last[axis]);
        }
      }
    });
  }
  std::map<LabelType, ImageRegion<3>> boxes;
  for (const auto & [label, corner] : corners)
  {
    ImageRegion<3> & box = boxes[label];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const auto period = static_cast<IndexValueType>(map.GetPeriod()[axis]);
      const IndexValueType low = corner.first[axis] * period - period - LabelMargin;
      const IndexValueType high = corner.second[axis] * period + period + LabelMargin;
      box.SetIndex(axis, low);
      box.SetSize(axis, static_cast<SizeValueType>(high - low + 1));
    }
    box.Crop(map.GetGrid().GetLargestPossibleRegion());
  }
  return boxes;
}

/** Finds a box of sites that holds those at some refined voxels. */
ImageRegion<3>
FindSites(const RefinedMap & map, const FieldLattice & lattice, const ImageRegion<3> & voxels)
{
  const Index<3> & first = voxels.GetIndex();
  const Index<3> last = voxels.GetUpperIndex();
  const auto corners = BoundingBox<>::PointsContainer::New();
  for (IndexValueType z = first[2]; z <= last[2]; ++z) // slices may be shifted against each other
  {
    for (unsigned int corner = 0; corner < 4; ++corner)
    {
      const Index<3> voxel{ { (corner & 1) != 0 ? last[0] : first[0], (corner & 2) != 0 ? last[1] : first[1], z } };
      const auto point = lattice.TransformPhysicalPointToLattice(map.GetPosition(voxel));
      corners->InsertElement(corners->Size(), Point<double, 3>(point));
    }
  }
  const auto box = BoundingBox<>::New();
  box->SetPoints(corners);
  ImageRegion<3> sites;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double step = axis == 0 ? 2.0 : 1.0;
    const auto begin = Math::Floor<IndexValueType>((box->GetMinimum()[axis] - 1.0) / step);
    const auto end = Math::Ceil<IndexValueType>((box->GetMaximum()[axis] + 1.0) / step) + 1;
    sites.SetIndex(axis, begin);
    sites.SetSize(axis, static_cast<SizeValueType>(end - begin));
  }
  sites.Crop(lattice.GetLargestPossibleRegion());
  return sites;
}

/** Makes the mask of a label in a box of the refined map: 1 at voxels nearest to its voxels, 0 at others. */
MaskImage::Pointer
MakeMask(const RefinedMap & map, LabelType label, const ImageRegion<3> & box)
{
  const auto mask = MaskImage::New();
  mask->CopyInformation(&map.GetGrid());
  mask->SetRegions(box);
  AllocateInBulk(*mask);
  std::vector<SizeValueType> nearest(box.GetSize(0));
  for (SizeValueType n = 0; n < nearest.size(); ++n)
  {
    nearest[n] = map.GetNearest(0, box.GetIndex(0) + static_cast<IndexValueType>(n));
  }
  ForEachRow(box, [&](const Index<3> & first, SizeValueType offset) {
    const LabelType * const labels = map.GetNearestRow(first);
    std::transform(nearest.begin(), nearest.end(), mask->GetBufferPointer() + offset, [&](SizeValueType x) {
      return static_cast<std::uint8_t>(labels[x] == label ? 1 : 0);
    });
  });
  return mask;
}

/** The blocks of the map's voxels at junctions, where the field of label 0 is made. */
LabelBlocks
FindJunctions(const LabelImage & labels, const RefinedMap & map)
{
  return { labels, map.GetPeriod(), LabelReach * AntiAliasMaskImageFilter::FindWidening(map.GetPeriod()) };
}

/** Whether one of \a length refined voxels of a row is at a junction or within reach of one. */
bool
AreNearJunction(const RefinedMap & map, const LabelBlocks & junctions, const Index<3> & first, SizeValueType length)
{
  const auto blockOf = [&](unsigned int axis, IndexValueType index) {
    return map.GetNearest(axis, index) / junctions.GetEdges()[axis];
  };
  const SizeValueType last = blockOf(0, first[0] + static_cast<IndexValueType>(length) - 1);
  for (SizeValueType x = blockOf(0, first[0]); x <= last; ++x)
  {
    if (junctions.IsNearJunction(x, blockOf(1, first[1]), blockOf(2, first[2])))
    {
      return true;
    }
  }
  return false;
}

/** Makes a label's field, in the box of its mask, that of label 0 near junctions only, and finds the mask's thin
 * voxels: the result is the filter that has them. No label but 0 reaches beyond the map. */
AntiAliasMaskImageFilter::Pointer
MakeField(const RefinedMap & map,
          const LabelBlocks & junctions,
          LabelType label,
          const ImageRegion<3> & box,
          ThreadIdType threads)
{
  const auto filter = AntiAliasMaskImageFilter::New();
  filter->SetInput(MakeMask(map, label, box));
  filter->SetNumberOfWorkUnits(threads);
  filter->SetSamplePeriod(map.GetPeriod());
  filter->ProtectSpecksOnlyOn(); // candidates keep the other thin parts whole
  if (label == 0)
  {
    filter->SetNeeded(
      [&](const Index<3> & first, SizeValueType length) { return AreNearJunction(map, junctions, first, length); });
  }
  filter->Update();
  filter->SetNeeded(nullptr);
  std::vector<float> depthsInMap(box.GetSize(0));
  for (SizeValueType n = 0; n < depthsInMap.size(); ++n)
  {
    depthsInMap[n] = map.GetDepth(0, box.GetIndex(0) + static_cast<IndexValueType>(n));
  }
  ForEachRow(box, [&](const Index<3> & first, SizeValueType offset) {
    const float rowDepth = std::min(map.GetDepth(1, first[1]), map.GetDepth(2, first[2]));
    const float side = label == 0 ? -1.0f : 1.0f;
    float * const row = filter->GetOutput()->GetBufferPointer() + offset;
    for (SizeValueType n = 0; n < depthsInMap.size(); ++n)
    {
      const float depth = std::clamp(row[n], -FCCLabelWeights::Limit, FCCLabelWeights::Limit);
      row[n] = side * std::min(side * depth, std::min(rowDepth, depthsInMap[n]));
    }
  });
  return filter;
}

/** Resamples a field onto a box of sites; beside a slanted map weights are lowest. */
FieldLattice::Pointer
ResampleField(const CartesianToFCCRows & rows,
              const FieldImage & field,
              const FieldLattice & lattice,
              const ImageRegion<3> & sites)
{
  const auto weights = FieldLattice::New();
  weights->CopyInformation(&lattice);
  weights->SetBufferedRegion(sites);
  AllocateInBulk(*weights);
  weights->FillBuffer(-FCCLabelWeights::Limit);
  const auto load = [&field](const Index<3> & start, SizeValueType length, float * row) {
    std::copy_n(field.GetBufferPointer() + field.ComputeOffset(start), length, row);
  };
  const auto store = [&weights](const Index<3> & start, SizeValueType length, const float * values) {
    std::copy_n(values, length, weights->GetBufferPointer() + weights->ComputeOffset(start));
  };
  constexpr std::size_t planes = 16; // of a slab for one thread
  rhombic::ForEachBlock(sites.GetSize(2), planes, [&](std::size_t begin, std::size_t end) {
    ImageRegion<3> slab = sites;
    slab.SetIndex(2, sites.GetIndex(2) + static_cast<IndexValueType>(begin));
    slab.SetSize(2, end - begin);
    rows.Resample(slab, load, store);
  });
  return weights;
}

/** The sites nearest to some voxels of an image in the refined map. */
BulkVector<FCCLattice::SiteType>
FindNearestSites(const RefinedMap & map,
                 const MaskImage & mask,
                 const BulkVector<SizeValueType> & voxels,
                 const Lattice & labels)
{
  BulkVector<FCCLattice::SiteType> sites;
  std::transform(voxels.begin(), voxels.end(), std::back_inserter(sites), [&](SizeValueType voxel) {
    const Index<3> index = mask.ComputeIndex(static_cast<OffsetValueType>(voxel));
    return FCCLattice::NearestSite(labels.TransformPhysicalPointToLattice(map.GetPosition(index)));
  });
  return sites;
}

/** The sites nearest to the voxels of label 0 that the field of another label protects. */
BulkVector<FCCLattice::SiteType>
FindLockedOfZero(const RefinedMap & map, const AntiAliasMaskImageFilter & field, const Lattice & labels)
{
  const MaskImage & mask = *field.GetInput();
  BulkVector<SizeValueType> voxels = field.GetProtectedOutsideVoxels();
  const auto isOfOther = [&](SizeValueType voxel) {
    const Index<3> index = mask.ComputeIndex(static_cast<OffsetValueType>(voxel));
    return map.GetNearestRow(index)[map.GetNearest(0, index[0])] != 0;
  };
  voxels.erase(std::remove_if(voxels.begin(), voxels.end(), isOfOther), voxels.end());
  return FindNearestSites(map, mask, voxels, labels);
}

/** Finds a label's candidates: the sites that its thin parts pass. Candidates of protected voxels are locked, and those
 * at some other sites. */
LabelTopology::Candidates
FindCandidates(const RefinedMap & map,
               const AntiAliasMaskImageFilter & field,
               LabelType label,
               const Lattice & labels,
               BulkVector<FCCLattice::SiteType> locked)
{
  const MaskImage & mask = *field.GetInput();
  const auto place = [&](const Index<3> & voxel) {
    return labels.TransformPhysicalPointToLattice(map.GetPosition(voxel));
  };
  const auto protectedSites = FindNearestSites(map, mask, field.GetProtectedVoxels(), labels);
  locked.insert(locked.end(), protectedSites.begin(), protectedSites.end());
  std::sort(locked.begin(), locked.end());
  LabelTopology::Candidates candidates;
  for (const FCCLattice::SiteType & site : FindThinPartSites(mask, map.GetMapRegion(), field.GetThinVoxels(), place))
  {
    const Index<3> index = FCCLattice::IndexOf(site);
    if (labels.GetLargestPossibleRegion().IsInside(index))
    {
      candidates.push_back({ static_cast<SizeValueType>(labels.ComputeOffset(index)),
                             label,
                             std::binary_search(locked.begin(), locked.end(), site) });
    }
  }
  return candidates;
}

/** A label with its box, and with its weights and candidates on the lattice. */
struct LabelInBox
{
  LabelType label;
  ImageRegion<3> sites;  ///< near the label
  ImageRegion<3> voxels; ///< of the refined map, on which the weights at the sites depend
  FieldLattice::Pointer weights;
  LabelTopology::Candidates candidates;
  BulkVector<FCCLattice::SiteType> lockedOfZero; ///< sites of voxels of label 0 that this label's field protects
};

/** For each site of the lattice, 1 where the border of label 0 has one neighbour and 0 elsewhere. */
BulkVector<std::uint8_t>
FindSitesOfOneNeighbor(const RefinedMap & map, const LabelBlocks & junctions, const FieldLattice & lattice)
{
  const ImageRegion<3> & whole = lattice.GetLargestPossibleRegion();
  BulkVector<std::uint8_t> hasOneNeighbor(whole.GetNumberOfPixels());
  ForEachRow(whole, [&](const Index<3> &, SizeValueType offset) {
    std::fill_n(hasOneNeighbor.data() + offset, whole.GetSize(0), std::uint8_t{ 0 });
  });
  const auto offsetOf = [&whole](const Index<3> & site) {
    const Offset<3> from = site - whole.GetIndex();
    return (static_cast<SizeValueType>(from[2]) * whole.GetSize(1) + static_cast<SizeValueType>(from[1])) *
             whole.GetSize(0) +
           static_cast<SizeValueType>(from[0]);
  };
  const LabelBlocks::SizeType & size = junctions.GetSize();
  const auto mark = [&](SizeValueType begin, SizeValueType end, SizeValueType y, SizeValueType z) {
    ImageRegion<3> voxels;
    const std::array<std::array<SizeValueType, 2>, 3> blocks{ { { begin, end }, { y, y + 1 }, { z, z + 1 } } };
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      // Blocks at the border hold what is beyond the map.
      const auto edge = static_cast<IndexValueType>(junctions.GetEdges()[axis] * map.GetPeriod()[axis]);
      const auto half = static_cast<IndexValueType>(map.GetPeriod()[axis] / 2);
      const ImageRegion<3> & grid = map.GetGrid().GetLargestPossibleRegion();
      const IndexValueType first =
        blocks[axis][0] == 0 ? grid.GetIndex(axis) : static_cast<IndexValueType>(blocks[axis][0]) * edge - half;
      const IndexValueType last = blocks[axis][1] == size[axis]
                                    ? grid.GetUpperIndex()[axis]
                                    : static_cast<IndexValueType>(blocks[axis][1]) * edge - half - 1;
      voxels.SetIndex(axis, first);
      voxels.SetSize(axis, static_cast<SizeValueType>(last - first + 1));
    }
    const ImageRegion<3> sites = FindSites(map, lattice, voxels);
    for (SizeValueType row = 0; row < sites.GetSize(1) * sites.GetSize(2); ++row)
    {
      Index<3> first = sites.GetIndex();
      first[1] += static_cast<IndexValueType>(row % sites.GetSize(1));
      first[2] += static_cast<IndexValueType>(row / sites.GetSize(1));
      std::fill_n(
        hasOneNeighbor.begin() + static_cast<std::ptrdiff_t>(offsetOf(first)), sites.GetSize(0), std::uint8_t{ 1 });
    }
  };
  for (SizeValueType row = 0; row < size[1] * size[2]; ++row)
  {
    const SizeValueType y = row % size[1];
    const SizeValueType z = row / size[1];
    for (SizeValueType begin = 0, end = 0; begin < size[0]; begin = end + 1)
    {
      end = begin;
      while (end < size[0] && junctions.HasOneNeighbor(end, y, z))
      {
        ++end;
      }
      if (end > begin)
      {
        mark(begin, end, y, z);
      }
    }
  }
  return hasOneNeighbor;
}

/** Computes the volumes of the voxels of each label in mm^3. */
std::vector<double>
ComputeVoxelVolumes(const LabelImage & map, const SliceOrigins & origins)
{
  const SizeValueType voxelsOfSlice =
    map.GetLargestPossibleRegion().GetSize(0) * map.GetLargestPossibleRegion().GetSize(1);
  const LabelType * slice = map.GetBufferPointer();
  std::vector<double> volumes(1);
  for (const double voxelVolume : rhombic::VoxelVolumesOf(map, origins))
  {
    std::map<LabelType, SizeValueType> counts;
    rhombic::ForEachRun(slice, voxelsOfSlice, [&](LabelType label, SizeValueType begin, SizeValueType end) {
      counts[label] += end - begin;
    });
    for (const auto & [label, count] : counts)
    {
      volumes.resize(std::max(volumes.size(), std::size_t{ label } + 1));
      volumes[label] += static_cast<double>(count) * voxelVolume;
    }
    slice += voxelsOfSlice;
  }
  return volumes;
}

} // namespace

void
LabelsToFCCFilter::SetSliceOrigins(const SliceOriginsType & origins)
{
  if (origins != m_SliceOrigins)
  {
    m_SliceOrigins = origins;
    this->Modified();
  }
}

void
LabelsToFCCFilter::SetGroups(const GroupsType & groups)
{
  if (groups != m_Groups)
  {
    m_Groups = groups;
    this->Modified();
  }
}

LabelsToFCCFilter::SliceOriginsType
LabelsToFCCFilter::FindSliceOrigins() const
{
  return m_SliceOrigins.empty() ? itk::FindSliceOrigins(*this->GetInput(), m_Scan) : m_SliceOrigins;
}

void
LabelsToFCCFilter::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "SliceOrigins: ";
  PrintSliceOrigins(os, m_SliceOrigins);
  os << std::endl << indent << "SliceOrigins of the scan: ";
  PrintSliceOrigins(os, m_Scan.origins);
  os << std::endl;
  os << indent << "Groups: " << m_Groups.size() << std::endl;
}

void
LabelsToFCCFilter::GenerateOutputInformation()
{
  const InputImageType & image = *this->GetInput();
  const auto & region = image.GetLargestPossibleRegion();
  const SliceOriginsType origins = this->FindSliceOrigins();
  if (region.GetNumberOfPixels() == 0 || (!origins.empty() && origins.size() != region.GetSize(2)))
  {
    itkExceptionMacro("The map has " << region.GetSize() << " voxels and " << origins.size()
                                     << " slice origins; it needs voxels, and an origin for each slice or none.");
  }
  this->GetOutput()->CopyInformation(MakeLattice(RefinedMap(image, origins), this->GetDensity()));
}

void
LabelsToFCCFilter::GenerateData()
{
  const InputImageType & image = *this->GetInput();
  VerifyInputSamples(*this, image, image.GetLargestPossibleRegion());
  const SliceOriginsType origins = this->FindSliceOrigins();
  const RefinedMap map(image, origins);
  const FieldLattice::ConstPointer lattice = MakeLattice(map, this->GetDensity());
  const CartesianToFCCRows rows(map.GetGrid(), *lattice, SeparableKernel::CubicBSpline, map.GetSliceOrigins());
  std::vector<LabelInBox> boxes;
  for (const auto & [label, box] : FindBoxes(image, map))
  {
    const ImageRegion<3> sites = FindSites(map, *lattice, box);
    boxes.push_back({ label, sites, rows.FindNeededSamples(sites), nullptr, {}, {} });
  }
  WorkProgress progress(*this, boxes.size() + 1);

  // Not the outputs: as inputs of the filter of walls, outputs would ask for an update of this filter.
  const auto labels = LatticeType::New();
  labels->CopyInformation(lattice);
  labels->SetRegions(lattice->GetLargestPossibleRegion());
  AllocateInBulk(*labels);
  const auto weights = FCCLabelWeights::New();
  StrongestLabels strongest(*labels, *weights);
  const LabelBlocks junctions = FindJunctions(image, map);
  const auto make = [&](LabelInBox & box, ThreadIdType threads, const BulkVector<FCCLattice::SiteType> & locked) {
    progress.CheckAbort();
    const auto field = MakeField(map, junctions, box.label, box.voxels, threads);
    box.candidates = FindCandidates(map, *field, box.label, *labels, locked);
    box.lockedOfZero = FindLockedOfZero(map, *field, *labels);
    box.weights = ResampleField(rows, *field->GetOutput(), *lattice, box.sites);
    progress.Completed(1);
  };
  LabelTopology::Candidates candidates;
  BulkVector<FCCLattice::SiteType> lockedOfZero;
  const auto addTo = [](auto & all, const auto & some) { all.insert(all.end(), some.begin(), some.end()); };
  for (auto begin = boxes.begin() + (boxes.empty() ? 0 : 1), end = begin; begin != boxes.end();)
  {
    // Labels are made side by side while their boxes have together no more voxels than the box of label 0, the first;
    // a large one is made alone, by all threads.
    const auto voxelsOf = [](const LabelInBox & box) { return box.voxels.GetNumberOfPixels(); };
    const auto isLarge = [&](const LabelInBox & box) { return 4 * voxelsOf(box) > voxelsOf(boxes.front()); };
    SizeValueType voxels = voxelsOf(*begin);
    end = std::find_if(begin + 1, isLarge(*begin) ? begin + 1 : boxes.end(), [&](const LabelInBox & box) {
      voxels += voxelsOf(box);
      return isLarge(box) || voxels > voxelsOf(boxes.front());
    });
    const ThreadIdType threads = end - begin > 1 ? 1 : this->GetNumberOfWorkUnits();
    rhombic::ForEachOnThreads(static_cast<std::size_t>(end - begin),
                              [&](std::size_t n) { make(begin[static_cast<std::ptrdiff_t>(n)], threads, {}); });
    for (; begin != end; ++begin)
    {
      strongest.Add(*begin->weights, begin->label);
      begin->weights = nullptr;
      addTo(candidates, begin->candidates);
      addTo(lockedOfZero, begin->lockedOfZero);
    }
  }
  if (!boxes.empty()) // label 0, whose weights are mostly those of others
  {
    make(boxes.front(), this->GetNumberOfWorkUnits(), lockedOfZero);
    strongest.AddZero(*boxes.front().weights, FindSitesOfOneNeighbor(map, junctions, *lattice));
    boxes.front().weights = nullptr;
    addTo(candidates, boxes.front().candidates);
  }
  strongest.SortWeights();
  LabelTopology topology(
    *labels, *weights, m_Groups, [&map](const Point<double, 3> & point) { return map.IsBackground(point); });
  topology.Assign(std::move(candidates));
  m_VoxelVolumes = ComputeVoxelVolumes(image, origins);
  LabelsToKeep keep{ m_VoxelVolumes, std::vector<ImageRegion<3>>(m_VoxelVolumes.size()) };
  for (const LabelInBox & box : boxes)
  {
    keep.sites[box.label] = box.sites;
  }
  KeepLabelVolumes(keep, rhombic::MeanSpacingOf(map.GetGrid()), *labels, *weights, topology);
  this->GetOutput()->Graft(labels);
  this->GetWeights()->Swap(*weights);
  progress.Finish();
}

} // namespace itk
