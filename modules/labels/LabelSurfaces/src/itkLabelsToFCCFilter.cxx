#include "itkLabelsToFCCFilter.h"

#include "itkAntiAliasMaskImageFilter.h"
#include "itkCartesianToFCCImageFilter.h"
#include "itkFCCLabelSurfaceFilter.h"
#include "itkImageSource.h"
#include "itkInputSamples.h"
#include "itkLabelWallAreas.h"
#include "itkLabelTopology.h"
#include "itkLabelsOnLattice.h"
#include "itkMath.h"
#include "itkThinPartSites.h"
#include "itkWorkProgress.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace itk
{
namespace
{

using LabelType = LabelsToFCCFilter::LabelType;
using LabelImage = LabelsToFCCFilter::InputImageType;
using Lattice = LabelsToFCCFilter::LatticeType;
using MaskImage = Image<std::uint8_t, 3>;
using FieldImage = Image<float, 3>;
using FieldLattice = FCCImage<float>;

constexpr unsigned int MostVolumeCorrections = 6;
constexpr double SteepestSlope = 3.0;     // of volumes, times that from the area
constexpr double SettledOffset = 0.008;   // of weights: layers of 0.004 voxels
constexpr double FarthestOffset = 2.0;    // of weights; twice as far as walls move, in voxels
constexpr IndexValueType Margin = 2;      // voxels around the map
constexpr IndexValueType LabelMargin = 4; // voxels around a label in which it has weights

/** The map refined to nearly cubic voxels. Samples of the map are those whose index is a multiple of the period. */
class RefinedMap
{
public:
  RefinedMap(const LabelImage & labels, const LabelsToFCCFilter::SliceOriginsType & origins)
    : m_Labels(labels)
    , m_Period(DivideVoxels(labels.GetSpacing()))
  {
    const auto & size = labels.GetLargestPossibleRegion().GetSize();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      m_Scan.SetIndex(axis, -static_cast<IndexValueType>(m_Period[axis] / 2));
      m_Scan.SetSize(axis, (size[axis] - 1) * m_Period[axis] + 1 + 2 * (m_Period[axis] / 2));
    }
    m_Whole = m_Scan;
    m_Whole.PadByRadius(Margin);
    this->PlaceSlices(origins);
  }

  const std::array<SizeValueType, 3> &
  GetPeriod() const
  {
    return m_Period;
  }

  /** The edge of a cube of a refined voxel's volume, in mm. */
  double
  GetVoxelEdge() const
  {
    double volume = 1.0;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      volume *= m_Labels.GetSpacing()[axis] / static_cast<double>(m_Period[axis]);
    }
    return std::cbrt(volume);
  }

  /** The map. */
  const ImageRegion<3> &
  GetScan() const
  {
    return m_Scan;
  }

  /** With the margin around the map. */
  const ImageRegion<3> &
  GetWhole() const
  {
    return m_Whole;
  }

  const LabelsToFCCFilter::SliceOriginsType &
  GetSliceOrigins() const
  {
    return m_SliceOrigins;
  }

  /** The position of a voxel's centre in the world. \param image on the refined grid */
  Point<double, 3>
  GetPosition(const ImageBase<3> & image, const Index<3> & index) const
  {
    Index<3> inSlice = index;
    if (!m_SliceOrigins.empty())
    {
      inSlice[2] = m_Whole.GetIndex(2);
    }
    const auto position = image.TransformIndexToPhysicalPoint<double>(inSlice);
    return m_SliceOrigins.empty() ? position
                                  : position + (m_SliceOrigins[static_cast<std::size_t>(index[2] - inSlice[2])] -
                                                image.TransformIndexToPhysicalPoint<double>(m_Whole.GetIndex()));
  }

  /** An image on the refined grid, of which only a region is to be in memory, not allocated. */
  template <typename TImage>
  typename TImage::Pointer
  MakeImage(const ImageRegion<3> & region) const
  {
    const auto image = TImage::New();
    auto spacing = m_Labels.GetSpacing();
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      spacing[axis] /= static_cast<double>(m_Period[axis]);
    }
    image->SetLargestPossibleRegion(m_Whole);
    image->SetBufferedRegion(region);
    image->SetRequestedRegion(region);
    image->SetSpacing(spacing);
    image->SetDirection(m_Labels.GetDirection());
    image->SetOrigin(m_Labels.TransformIndexToPhysicalPoint<double>(m_Labels.GetLargestPossibleRegion().GetIndex()));
    return image;
  }

  /** The index along an axis of the nearest voxel of the map, from its first; beyond the map of that at its border. */
  SizeValueType
  GetNearest(unsigned int axis, IndexValueType index) const
  {
    const IndexValueType last = m_Scan.GetUpperIndex()[axis];
    const IndexValueType inScan = std::clamp(index, m_Scan.GetIndex(axis), last) - m_Scan.GetIndex(axis);
    return std::min(static_cast<SizeValueType>(inScan) / m_Period[axis],
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

  /** Depth along one axis below the outer faces of the map, negative beyond it. */
  float
  GetDepth(unsigned int axis, IndexValueType index) const
  {
    const double outer = 0.5 * static_cast<double>(m_Period[axis]);
    const auto last = static_cast<double>((m_Labels.GetLargestPossibleRegion().GetSize(axis) - 1) * m_Period[axis]);
    const auto position = static_cast<double>(index);
    return static_cast<float>(std::min(position + outer, last + outer - position));
  }

  /** The bounding box of each label and a margin around it; of 0, that of all others together. */
  std::map<LabelType, ImageRegion<3>>
  FindBoxes() const
  {
    std::map<LabelType, std::pair<Index<3>, Index<3>>> corners;
    const auto add = [&corners](LabelType label, const Index<3> & index) {
      auto & [low, high] = corners.try_emplace(label, index, index).first->second;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], index[axis]);
        high[axis] = std::max(high[axis], index[axis]);
      }
    };
    const auto & size = m_Labels.GetLargestPossibleRegion().GetSize();
    const LabelType * voxels = m_Labels.GetBufferPointer();
    for (SizeValueType row = 0; row < size[1] * size[2]; ++row, voxels += size[0])
    {
      for (SizeValueType x = 0; x < size[0]; ++x)
      {
        // The ends of runs of one label are enough.
        const bool isInner = x > 0 && x + 1 < size[0] && voxels[x] == voxels[x - 1] && voxels[x] == voxels[x + 1];
        if (voxels[x] != 0 && !isInner)
        {
          const Index<3> index{ { static_cast<IndexValueType>(x),
                                  static_cast<IndexValueType>(row % size[1]),
                                  static_cast<IndexValueType>(row / size[1]) } };
          add(voxels[x], index);
          add(0, index);
        }
      }
    }
    std::map<LabelType, ImageRegion<3>> boxes;
    for (const auto & [label, corner] : corners)
    {
      ImageRegion<3> box;
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const auto period = static_cast<IndexValueType>(m_Period[axis]);
        const IndexValueType margin = LabelMargin + period;
        const IndexValueType low = corner.first[axis] * period - margin;
        const IndexValueType high = corner.second[axis] * period + margin;
        box.SetIndex(axis, low);
        box.SetSize(axis, static_cast<SizeValueType>(high - low + 1));
      }
      box.Crop(m_Whole);
      boxes[label] = box;
    }
    return boxes;
  }

private:
  /** Positions of the first voxels of the refined slices, from the slices of the map and with the margin. */
  void
  PlaceSlices(const LabelsToFCCFilter::SliceOriginsType & origins)
  {
    if (origins.size() < 2)
    {
      return;
    }
    Vector<double, 3> toFirst(0.0);
    for (unsigned int axis = 0; axis < 2; ++axis)
    {
      toFirst[axis] =
        static_cast<double>(m_Whole.GetIndex(axis)) / static_cast<double>(m_Period[axis]) * m_Labels.GetSpacing()[axis];
    }
    toFirst = m_Labels.GetDirection() * toFirst;
    for (IndexValueType k = m_Whole.GetIndex(2); k <= m_Whole.GetUpperIndex()[2]; ++k)
    {
      const double position = static_cast<double>(k) / static_cast<double>(m_Period[2]);
      const auto slice =
        static_cast<std::size_t>(std::clamp(std::floor(position), 0.0, static_cast<double>(origins.size() - 2)));
      const double share = position - static_cast<double>(slice);
      m_SliceOrigins.push_back(origins[slice] + (origins[slice + 1] - origins[slice]) * share + toFirst);
    }
  }

  const LabelImage & m_Labels;
  std::array<SizeValueType, 3> m_Period;
  ImageRegion<3> m_Scan;
  ImageRegion<3> m_Whole;
  LabelsToFCCFilter::SliceOriginsType m_SliceOrigins;
};

/** A label in its box of the refined map. */
struct LabelField
{
  LabelType label;
  ImageRegion<3> sites;                     ///< of the lattice, near the label
  ImageRegion<3> voxels;                    ///< that the values there depend on
  FieldImage::Pointer depths;               ///< below the label's surface, in voxels
  std::vector<LabelTopology::Claim> claims; ///< of its thin parts
};

/** The filter whose output are the depths below a label's surface, in voxels of a box. */
AntiAliasMaskImageFilter::Pointer
MakeField(const RefinedMap & map, LabelType label, const ImageRegion<3> & box, ThreadIdType threads)
{
  const SizeValueType width = box.GetSize(0);
  std::vector<SizeValueType> nearest(width);
  std::vector<float> depths(width);
  for (SizeValueType n = 0; n < width; ++n)
  {
    const IndexValueType x = box.GetIndex(0) + static_cast<IndexValueType>(n);
    nearest[n] = map.GetNearest(0, x);
    depths[n] = map.GetDepth(0, x);
  }
  const auto mask = map.MakeImage<MaskImage>(box);
  mask->SetLargestPossibleRegion(box);
  mask->Allocate();
  ForEachRow(box, [&](const Index<3> & first, SizeValueType offset) {
    const LabelType * const labels = map.GetNearestRow(first);
    std::uint8_t * const row = mask->GetBufferPointer() + offset;
    for (SizeValueType n = 0; n < width; ++n)
    {
      row[n] = labels[nearest[n]] == label ? 1 : 0;
    }
  });
  const auto filter = AntiAliasMaskImageFilter::New();
  filter->SetInput(mask);
  filter->SetNumberOfWorkUnits(threads);
  filter->SetSamplePeriod(map.GetPeriod());
  filter->ProtectSpecksOnlyOn(); // the claims of thin parts keep the others whole
  filter->Update();
  FieldImage * const field = filter->GetOutput();
  ForEachRow(box, [&](const Index<3> & first, SizeValueType offset) {
    // No label but 0 reaches beyond the map.
    const float rowDepth = std::min(map.GetDepth(1, first[1]), map.GetDepth(2, first[2]));
    const float side = label == 0 ? -1.0f : 1.0f;
    float * const row = field->GetBufferPointer() + offset;
    for (SizeValueType n = 0; n < width; ++n)
    {
      const float depth = std::clamp(row[n], -FCCLabelWeights::Limit, FCCLabelWeights::Limit);
      row[n] = side * std::min(side * depth, std::min(rowDepth, depths[n]));
    }
  });
  return filter;
}

/** \class FieldSource
 * \brief The source of a field that is a part of the refined map: images without a source end at their buffer. */
class FieldSource : public ImageSource<FieldImage>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FieldSource);

  using Self = FieldSource;
  using Superclass = ImageSource<FieldImage>;
  using Pointer = SmartPointer<Self>;

  itkNewMacro(Self);

  FieldImage::Pointer field;
  ImageRegion<3> whole;

protected:
  FieldSource() = default;
  ~FieldSource() override = default;

  void
  GenerateOutputInformation() override
  {
    this->GetOutput()->CopyInformation(field);
    this->GetOutput()->SetLargestPossibleRegion(whole);
  }

  void
  GenerateData() override
  {
    this->GetOutput()->SetBufferedRegion(field->GetBufferedRegion());
    this->GetOutput()->SetPixelContainer(field->GetPixelContainer());
  }
};

/** \class FieldResampler
 * \brief Resamples a field of the refined map onto its lattice. */
class FieldResampler
{
public:
  using Filter = CartesianToFCCImageFilter<FieldImage>;

  FieldResampler(const RefinedMap & map, double density)
    : m_Map(map)
    , m_Source(FieldSource::New())
    , m_Filter(Filter::New())
  {
    m_Source->field = map.MakeImage<FieldImage>(map.GetWhole());
    m_Source->whole = map.GetWhole();
    m_Source->ReleaseDataFlagOn();
    m_Filter->SetInput(m_Source->GetOutput());
    m_Filter->SetDensity(density);
    m_Filter->SetSliceOrigins(map.GetSliceOrigins());
    m_Filter->SetOutsideValue(-FCCLabelWeights::Limit);
    m_Filter->UpdateOutputInformation();
  }

  /** The lattice, without samples. */
  const FieldLattice &
  GetLattice() const
  {
    return *m_Filter->GetOutput();
  }

  /** A box of sites that holds those at some voxels. */
  ImageRegion<3>
  FindSites(const ImageRegion<3> & voxels) const
  {
    const FieldLattice & lattice = this->GetLattice();
    std::array<double, 3> low;
    std::array<double, 3> high;
    low.fill(std::numeric_limits<double>::max());
    high.fill(std::numeric_limits<double>::lowest());
    const Index<3> & first = voxels.GetIndex();
    const Index<3> last = voxels.GetUpperIndex();
    for (IndexValueType z = first[2]; z <= last[2]; ++z)
    {
      for (const IndexValueType y : { first[1], last[1] })
      {
        for (const IndexValueType x : { first[0], last[0] })
        {
          const auto point =
            lattice.TransformPhysicalPointToLattice(m_Map.GetPosition(*m_Source->field, Index<3>{ { x, y, z } }));
          for (unsigned int axis = 0; axis < 3; ++axis)
          {
            low[axis] = std::min(low[axis], point[axis]);
            high[axis] = std::max(high[axis], point[axis]);
          }
        }
      }
    }
    ImageRegion<3> sites;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      const double step = axis == 0 ? 2.0 : 1.0;
      const auto begin = Math::Floor<IndexValueType>((low[axis] - 1.0) / step);
      sites.SetIndex(axis, begin);
      sites.SetSize(axis,
                    static_cast<SizeValueType>(Math::Ceil<IndexValueType>((high[axis] + 1.0) / step) - begin + 1));
    }
    sites.Crop(lattice.GetLargestPossibleRegion());
    return sites;
  }

  /** The voxels on which the values at some sites depend. */
  ImageRegion<3>
  FindVoxels(const ImageRegion<3> & sites) const
  {
    m_Filter->GetOutput()->SetRequestedRegion(sites);
    m_Filter->PropagateRequestedRegion(m_Filter->GetOutput());
    return m_Source->GetOutput()->GetRequestedRegion();
  }

  /** Empties the field. */
  const FieldLattice &
  Resample(FieldImage * field, const ImageRegion<3> & sites) const
  {
    m_Source->field = field;
    m_Source->Modified();
    m_Filter->GetOutput()->SetRequestedRegion(sites);
    m_Filter->Update();
    field->Initialize();
    return *m_Filter->GetOutput();
  }

private:
  const RefinedMap & m_Map;
  FieldSource::Pointer m_Source;
  Filter::Pointer m_Filter;
};

/** Adds the claims of a label to the sites that its thin parts pass. */
void
AddClaims(const RefinedMap & map,
          const AntiAliasMaskImageFilter & filter,
          LabelType label,
          const Lattice & labels,
          std::vector<LabelTopology::Claim> & claims)
{
  const MaskImage & mask = *filter.GetInput();
  const auto place = [&](const Index<3> & voxel) {
    return labels.TransformPhysicalPointToLattice(map.GetPosition(mask, voxel));
  };
  std::vector<FCCLattice::SiteType> held;
  for (const SizeValueType voxel : filter.GetProtectedVoxels())
  {
    held.push_back(FCCLattice::NearestSite(place(mask.ComputeIndex(static_cast<OffsetValueType>(voxel)))));
  }
  std::sort(held.begin(), held.end());
  for (const FCCLattice::SiteType & site : FindThinPartSites(mask, map.GetScan(), filter.GetThinVoxels(), place))
  {
    const Index<3> index = FCCLattice::IndexOf(site);
    if (labels.GetLargestPossibleRegion().IsInside(index))
    {
      claims.push_back({ static_cast<SizeValueType>(labels.ComputeOffset(index)),
                         label,
                         std::binary_search(held.begin(), held.end(), site) });
    }
  }
}

/** The volumes of the voxels of each label in mm^3. A slice reaches half way to its neighbours. */
std::vector<double>
ComputeVoxelVolumes(const LabelImage & map, LabelsToFCCFilter::SliceOriginsType origins)
{
  const auto & region = map.GetLargestPossibleRegion();
  const auto & spacing = map.GetSpacing();
  Index<3> first = region.GetIndex();
  for (SizeValueType k = 0; origins.size() < region.GetSize(2); ++k, ++first[2])
  {
    origins.push_back(map.TransformIndexToPhysicalPoint<double>(first));
  }
  Vector<double, 3> axes[3];
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (unsigned int row = 0; row < 3; ++row)
    {
      axes[axis][row] = map.GetDirection()(row, axis) * spacing[axis];
    }
  }
  const Vector<double, 3> area = CrossProduct(axes[0], axes[1]);
  const SizeValueType voxels = region.GetSize(0) * region.GetSize(1);
  std::vector<double> volumes(1);
  for (SizeValueType k = 0; k < region.GetSize(2); ++k)
  {
    std::map<LabelType, SizeValueType> counts;
    const LabelType * const slice = map.GetBufferPointer() + k * voxels;
    for (SizeValueType n = 0, end = 0; n < voxels; n = end)
    {
      end = static_cast<SizeValueType>(
        std::find_if(slice + n, slice + voxels, [&](LabelType label) { return label != slice[n]; }) - slice);
      counts[slice[n]] += end - n;
    }
    const bool hasBefore = k > 0;
    const bool hasAfter = k + 1 < region.GetSize(2);
    const auto steps = static_cast<double>((hasBefore ? 1 : 0) + (hasAfter ? 1 : 0));
    const Vector<double, 3> step =
      steps > 0.0 ? (origins[hasAfter ? k + 1 : k] - origins[hasBefore ? k - 1 : k]) / steps : axes[2];
    for (const auto & [label, count] : counts)
    {
      volumes.resize(std::max(volumes.size(), std::size_t{ label } + 1));
      volumes[label] += static_cast<double>(count) * std::abs(area * step);
    }
  }
  return volumes;
}

/** Moves the walls of all labels so that these have the volumes of their voxels. Labels grow by layers that follow from
 * the walls' areas; what they gained by the last layers, compared with what the areas say, corrects the next ones. */
void
KeepVolumes(const std::vector<double> & voxelVolumes,
            double voxelEdge,
            const Lattice & labels,
            const FCCLabelWeights & weights,
            LabelTopology & topology)
{
  // An offset of a weight moves a wall half as far, in voxels.
  const double layerOfOffset = 0.5 * voxelEdge;
  std::vector<double> offsets(voxelVolumes.size()); // of all rounds together
  std::vector<double> layers(voxelVolumes.size());  // of the last round
  std::vector<double> roots(voxelVolumes.size());   // cube roots of volumes, which are nearly linear in the layers
  bool isSettled = false;
  for (unsigned int n = 0; n < MostVolumeCorrections && !isSettled; ++n)
  {
    const auto filter = FCCLabelSurfaceFilter::New();
    filter->SetInput(&labels);
    filter->SetWeights(&weights);
    filter->Update();
    const LabelWallAreas areas(*filter->GetOutput());
    std::vector<double> volumes = filter->GetOutput()->ComputeVolumes();
    std::vector<double> gains = areas.FindGains(layers);
    volumes.resize(voxelVolumes.size());
    gains.resize(voxelVolumes.size());
    for (std::size_t label = 1; label < gains.size(); ++label)
    {
      const double root = std::cbrt(std::max(0.0, volumes[label]));
      const double slope = 3.0 * root * root;
      const double ratio = gains[label] != 0.0 ? slope * (root - roots[label]) / gains[label] : 1.0;
      gains[label] =
        slope * (std::cbrt(voxelVolumes[label]) - root) / std::clamp(ratio, 1.0 / SteepestSlope, SteepestSlope);
      roots[label] = root;
    }
    layers = areas.FindLayers(std::move(gains), [&](std::size_t label, double layer) {
      const double offset = label < offsets.size() ? offsets[label] : 0.0;
      return layerOfOffset * std::clamp(layer / layerOfOffset, -FarthestOffset - offset, FarthestOffset - offset);
    });
    layers.resize(offsets.size());
    std::vector<double> steps(offsets.size());
    for (std::size_t label = 1; label < offsets.size(); ++label)
    {
      steps[label] = layers[label] / layerOfOffset;
      offsets[label] += steps[label];
    }
    isSettled = std::all_of(steps.begin(), steps.end(), [](double step) { return std::abs(step) < SettledOffset; });
    topology.AddOffsets(std::move(steps));
  }
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
  const RefinedMap map(image, origins);
  this->GetOutput()->CopyInformation(&FieldResampler(map, this->GetDensity()).GetLattice());
}

void
LabelsToFCCFilter::GenerateData()
{
  const InputImageType & image = *this->GetInput();
  VerifyInputSamples(*this, image, image.GetLargestPossibleRegion());
  const SliceOriginsType origins = this->FindSliceOrigins();
  const RefinedMap map(image, origins);
  const FieldResampler resampler(map, this->GetDensity());
  std::vector<LabelField> fields;
  for (const auto & [label, box] : map.FindBoxes())
  {
    const ImageRegion<3> sites = resampler.FindSites(box);
    fields.push_back({ label, sites, resampler.FindVoxels(sites), nullptr, {} });
  }
  WorkProgress progress(*this, fields.size() + 1);

  // Not the outputs: as inputs of a filter, these would ask for an update of this one.
  const auto lattice = LatticeType::New();
  LatticeType & labels = *lattice;
  labels.CopyInformation(this->GetOutput());
  const auto & region = labels.GetLargestPossibleRegion();
  labels.SetRegions(region);
  labels.Allocate();
  labels.FillBuffer(0);
  const auto newWeights = FCCLabelWeights::New();
  FCCLabelWeights & weights = *newWeights;
  weights.SetNumberOfRows(region.GetSize(1) * region.GetSize(2));
  std::vector<LabelTopology::Claim> claims;
  std::vector<float> largest(region.GetNumberOfPixels(), -FCCLabelWeights::Limit);
  for (auto begin = fields.begin(), end = begin; begin != fields.end();)
  {
    // Side by side are made as many as have together no more voxels than the first, which is that of 0.
    SizeValueType voxels = begin->voxels.GetNumberOfPixels();
    end = std::find_if(begin + 1, fields.end(), [&](const LabelField & field) {
      voxels += field.voxels.GetNumberOfPixels();
      return voxels > fields.front().voxels.GetNumberOfPixels();
    });
    const ThreadIdType threads = end - begin > 1 ? 1 : this->GetNumberOfWorkUnits();
    rhombic::ForEachOnThreads(static_cast<std::size_t>(end - begin), [&](std::size_t n) {
      progress.CheckAbort();
      LabelField & field = begin[static_cast<std::ptrdiff_t>(n)];
      const auto filter = MakeField(map, field.label, field.voxels, threads);
      AddClaims(map, *filter, field.label, labels, field.claims);
      field.depths = filter->GetOutput();
      field.depths->DisconnectPipeline();
      progress.Completed(1);
    });
    for (; begin != end; ++begin)
    {
      const FieldResampler one(map, this->GetDensity());
      AddLabelWeights(one.Resample(begin->depths, begin->sites), begin->label, labels, largest, weights);
      claims.insert(claims.end(), begin->claims.begin(), begin->claims.end());
    }
  }
  SortWeights(region, weights);
  LabelTopology topology(labels, weights, m_Groups);
  topology.Grant(std::move(claims));
  m_VoxelVolumes = ComputeVoxelVolumes(image, origins);
  KeepVolumes(m_VoxelVolumes, map.GetVoxelEdge(), labels, weights, topology);
  this->GetOutput()->Graft(lattice);
  this->GetWeights()->Swap(weights);
  progress.Finish();
}

} // namespace itk
