#include "detail/itkCartesianToFCCRows.h"

#include "detail/itkRowArithmetic.h"
#include "itkFCCLattice.h"
#include "itkRowRing.h"
#include "itkSlicePlacement.h"

#include <algorithm>
#include <array>

namespace itk
{
namespace
{

/** Resamples from perpendicular axes: along y, z and x in turn.
 *
 * \param xTaps of the sites of even and of odd rows
 * \param region of the lattice, not empty
 * \param load is asked for samples counted from the input's first sample */
void
ResampleRows(const SeparableTaps (&xTaps)[2],
             const SeparableTaps & yTaps,
             const SeparableTaps & zTaps,
             const ImageRegion<3> & region,
             const LoadRow & load,
             const StoreRow & store)
{
  const SizeValueType width = region.GetSize(0);
  const SizeValueType xFirst = xTaps[0].GetFirst(0);
  const SizeValueType xCount = xTaps[1].GetFirst(width - 1) + xTaps[1].GetNumberOfTaps() - xFirst;
  const SizeValueType yCount = yTaps.GetNumberOfTaps();
  const SizeValueType zCount = zTaps.GetNumberOfTaps();
  const RowArithmetic::RowTaps rowTaps[2] = { { xTaps[0], width, xFirst }, { xTaps[1], width, xFirst } };

  // A slab is a plane of the input, blended along y at the rows of one block.
  const SizeValueType stride = RowArithmetic::PaddedLength(xCount);
  const SizeValueType blockSize = RowsPerBlock(zCount * stride, region.GetSize(1));
  RowRing inputRows(yCount, stride);
  RowRing slabs(zCount, blockSize * stride);
  std::vector<float> row(stride);
  std::vector<float> values(rowTaps[0].GetPaddedLength());
  std::vector<const float *> terms(std::max(yCount, zCount));

  for (SizeValueType blockBegin = 0; blockBegin < region.GetSize(1); blockBegin += blockSize)
  {
    const SizeValueType blockEnd = std::min(blockBegin + blockSize, region.GetSize(1));
    const auto makeSlab = [&](SizeValueType z, float * slab) {
      const auto loadRow = [&](SizeValueType y, float * inputRow) {
        load(
          { { static_cast<IndexValueType>(xFirst), static_cast<IndexValueType>(y), static_cast<IndexValueType>(z) } },
          xCount,
          inputRow);
      };
      inputRows.Restart();
      for (SizeValueType j = blockBegin; j < blockEnd; ++j)
      {
        const SizeValueType first = yTaps.GetFirst(j);
        inputRows.Advance(first, first + yCount, loadRow);
        for (SizeValueType tap = 0; tap < yCount; ++tap)
        {
          terms[tap] = inputRows.GetRow(first + tap);
        }
        RowArithmetic::Blend(terms.data(), yTaps.GetWeights(j), yCount, xCount, slab + (j - blockBegin) * stride);
      }
    };

    slabs.Restart();
    for (SizeValueType k = 0; k < region.GetSize(2); ++k)
    {
      const SizeValueType first = zTaps.GetFirst(k);
      slabs.Advance(first, first + zCount, makeSlab);
      for (SizeValueType j = blockBegin; j < blockEnd; ++j)
      {
        for (SizeValueType tap = 0; tap < zCount; ++tap)
        {
          terms[tap] = slabs.GetRow(first + tap) + (j - blockBegin) * stride;
        }
        RowArithmetic::Blend(terms.data(), zTaps.GetWeights(k), zCount, xCount, row.data());

        const Index<3> index{ { region.GetIndex(0),
                                region.GetIndex(1) + static_cast<IndexValueType>(j),
                                region.GetIndex(2) + static_cast<IndexValueType>(k) } };
        RowArithmetic::Interpolate(row.data(), rowTaps[FCCLattice::Parity(index[1], index[2])], values.data());
        store(index, width, values.data());
      }
    }
  }
}

/** z of a region's planes in the stack's frame, in mm. */
std::vector<double>
HeightsOf(const ImageRegion<3> & region, double origin, double spacing)
{
  std::vector<double> heights(region.GetSize(2));
  for (std::size_t k = 0; k < heights.size(); ++k)
  {
    heights[k] = origin + spacing * static_cast<double>(region.GetIndex(2) + static_cast<IndexValueType>(k));
  }
  return heights;
}

/** Whether a position along an axis, in samples from the first sample, lies in one of the axis' \a length voxels. */
bool
IsInsideVoxels(double position, SizeValueType length)
{
  constexpr double tolerance = 1e-6; // against rounding
  return position >= -0.5 - tolerance && position <= static_cast<double>(length) - 0.5 + tolerance;
}

/** Sets index and size of an axis to the samples that taps need. */
void
SetRange(const SeparableTaps & taps, SizeValueType numberOfPositions, unsigned int axis, ImageRegion<3> & range)
{
  SizeValueType first = taps.GetFirst(0);
  SizeValueType last = first;
  for (SizeValueType n = 1; n < numberOfPositions; ++n)
  {
    first = std::min(first, taps.GetFirst(n));
    last = std::max(last, taps.GetFirst(n));
  }
  range.SetIndex(axis, static_cast<IndexValueType>(first));
  range.SetSize(axis, last - first + taps.GetNumberOfTaps());
}

/** \class SliceStackPlanes
 * \brief Where the sites of a region of an FCC lattice lie between the samples of a SliceStack.
 *
 * The lattice's axes are the stack's frame. A plane of constant z is blended from slices, row by row; in that blend
 * rows and columns of samples start at the plane's own origin. Planes and rows of sites are counted from the region's
 * first plane and row, samples from the stack's first sample. Positions depend on a site's index alone, not on the
 * region. */
class SliceStackPlanes
{
public:
  using RegionType = ImageRegion<3>;

  /** \param stack of the volume; must outlive this
   *  \param region of the lattice, not empty */
  SliceStackPlanes(const SliceStack & stack,
                   SeparableKernel kernel,
                   const ImageBase<3> & volume,
                   const ImageBase<3> & lattice,
                   const RegionType & region)
    : m_Stack(stack)
    , m_Kernel(kernel)
    , m_Size(volume.GetLargestPossibleRegion().GetSize())
    , m_Origin(stack.TransformPointToFrame(lattice.GetOrigin()))
    , m_Spacing(lattice.GetSpacing())
    , m_Region(region)
    , m_Heights(HeightsOf(region, m_Origin[2], m_Spacing[2]))
    , m_SliceTaps(stack.MakeSliceTaps(kernel, m_Heights))
  {
    for (SizeValueType k = 0; k < m_Heights.size(); ++k)
    {
      m_PlaneOrigins.push_back(stack.GetOriginAt(m_Heights[k], m_SliceTaps, k));
    }
  }

  /** The slices each plane is blended from. */
  const SeparableTaps &
  GetSliceTaps() const
  {
    return m_SliceTaps;
  }

  /** The position in rows of samples, a real number, of each row of sites of plane \a k. */
  std::vector<double>
  GetRows(SizeValueType k) const
  {
    std::vector<double> rows(m_Region.GetSize(1));
    for (std::size_t j = 0; j < rows.size(); ++j)
    {
      const auto y = static_cast<double>(m_Region.GetIndex(1) + static_cast<IndexValueType>(j));
      rows[j] = m_Stack.GetRow(m_Origin[1] + m_Spacing[1] * y, m_PlaneOrigins[k]);
    }
    return rows;
  }

  /** Whether a position in rows of samples lies in the stack's voxels. */
  bool
  HasRow(double row) const
  {
    return IsInsideVoxels(row, m_Size[1]);
  }

  /** The taps of all \a rows, as GetRows() returns them. */
  SeparableTaps
  MakeRowTaps(const std::vector<double> & rows) const
  {
    return SeparableTaps(m_Kernel, m_Size[1], rows);
  }

  /** Whether each row of sites has taps of its own, because the in-plane axes are not perpendicular. Otherwise all rows
   * of a plane with the same parity share them. */
  bool
  AreRowsShifted() const
  {
    return m_Stack.AreRowsShifted();
  }

  /** The sites of a row: those from \a begin to before \a end lie in the stack's voxels. */
  struct SiteRow
  {
    SizeValueType begin;
    SizeValueType end;
    RowArithmetic::RowTaps taps; ///< taps of all sites
  };

  /** \param k plane
   *  \param row position in rows of samples
   *  \param parity of the row of sites
   *  \param xFirst first sample of the rows to interpolate */
  SiteRow
  MakeSiteRow(SizeValueType k, double row, IndexValueType parity, SizeValueType xFirst) const
  {
    const std::vector<double> columns = this->GetColumns(k, row, parity);
    const auto isInside = [this](double column) { return IsInsideVoxels(column, m_Size[0]); };
    const auto begin = std::find_if(columns.begin(), columns.end(), isInside);
    const auto end = std::find_if_not(begin, columns.end(), isInside);
    return { static_cast<SizeValueType>(begin - columns.begin()),
             static_cast<SizeValueType>(end - columns.begin()),
             { this->MakeColumnTaps(columns), columns.size(), xFirst } };
  }

  /** The samples that all sites are made of; its index counts from the stack's first sample. */
  RegionType
  FindNeededSamples() const
  {
    // Positions are linear in a plane's x and y, so its corners are the farthest.
    std::vector<double> rows;
    std::vector<double> columns;
    for (SizeValueType k = 0; k < m_Heights.size(); ++k)
    {
      const std::vector<double> planeRows = this->GetRows(k);
      for (const double row : { planeRows.front(), planeRows.back() })
      {
        rows.push_back(row);
        columns.push_back(this->GetColumns(k, row, 0).front());
        columns.push_back(this->GetColumns(k, row, 1).back());
      }
    }
    RegionType needed;
    SetRange(this->MakeColumnTaps(columns), columns.size(), 0, needed);
    SetRange(this->MakeRowTaps(rows), rows.size(), 1, needed);
    SetRange(m_SliceTaps, m_Heights.size(), 2, needed);
    return needed;
  }

private:
  /** The position along the row of samples, a real number, of each site of a row of plane \a k. */
  std::vector<double>
  GetColumns(SizeValueType k, double row, IndexValueType parity) const
  {
    std::vector<double> columns(m_Region.GetSize(0));
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      const auto x = static_cast<double>(2 * (m_Region.GetIndex(0) + static_cast<IndexValueType>(i)) + parity);
      columns[i] = m_Stack.GetColumn(m_Origin[0] + m_Spacing[0] * x, row, m_PlaneOrigins[k]);
    }
    return columns;
  }

  SeparableTaps
  MakeColumnTaps(const std::vector<double> & columns) const
  {
    return SeparableTaps(m_Kernel, m_Size[0], columns);
  }

  const SliceStack & m_Stack;
  SeparableKernel m_Kernel;
  Size<3> m_Size;
  SliceStack::VectorType m_Origin;
  SliceStack::VectorType m_Spacing;
  RegionType m_Region;
  std::vector<double> m_Heights;
  SeparableTaps m_SliceTaps;
  std::vector<std::array<double, 2>> m_PlaneOrigins;
};

/** Resamples a slice stack: along z, y and x in turn. Of each row, only the sites in the stack are stored; a row
 * without any is stored with a length of 0.
 *
 * \param region of the lattice, not empty: that of \a planes
 * \param load is asked for samples counted from the stack's first sample */
void
ResampleStackRows(const SliceStackPlanes & planes,
                  const ImageRegion<3> & region,
                  const LoadRow & load,
                  const StoreRow & store)
{
  const auto needed = planes.FindNeededSamples();
  const IndexValueType xFirst = needed.GetIndex(0);
  const SizeValueType xCount = needed.GetSize(0);
  const SeparableTaps & zTaps = planes.GetSliceTaps();
  const SizeValueType zCount = zTaps.GetNumberOfTaps();
  const SizeValueType stride = RowArithmetic::PaddedLength(xCount);

  std::vector<float> sliceRows(zCount * stride);
  std::vector<const float *> sliceTerms(zCount);
  for (SizeValueType tap = 0; tap < zCount; ++tap)
  {
    sliceTerms[tap] = sliceRows.data() + tap * stride;
  }
  const auto blendSlices = [&](SizeValueType k, SizeValueType y, float * blend) {
    const auto zFirst = static_cast<IndexValueType>(zTaps.GetFirst(k));
    for (SizeValueType tap = 0; tap < zCount; ++tap)
    {
      load({ { xFirst, static_cast<IndexValueType>(y), zFirst + static_cast<IndexValueType>(tap) } },
           xCount,
           sliceRows.data() + tap * stride);
    }
    RowArithmetic::Blend(sliceTerms.data(), zTaps.GetWeights(k), zCount, xCount, blend);
  };

  std::vector<float> row(stride);
  std::vector<float> values;
  for (SizeValueType k = 0; k < region.GetSize(2); ++k)
  {
    const std::vector<double> rows = planes.GetRows(k);
    const SeparableTaps yTaps = planes.MakeRowTaps(rows);
    const SizeValueType yCount = yTaps.GetNumberOfTaps();
    RowRing blendedRows(yCount, stride);
    std::vector<const float *> terms(yCount);
    std::optional<SliceStackPlanes::SiteRow> siteRows[2]; // by parity
    for (SizeValueType j = 0; j < region.GetSize(1); ++j)
    {
      Index<3> index{ { region.GetIndex(0),
                        region.GetIndex(1) + static_cast<IndexValueType>(j),
                        region.GetIndex(2) + static_cast<IndexValueType>(k) } };
      const IndexValueType parity = FCCLattice::Parity(index[1], index[2]);
      auto & sites = siteRows[parity];
      if (!sites || planes.AreRowsShifted())
      {
        sites.emplace(planes.MakeSiteRow(k, rows[j], parity, static_cast<SizeValueType>(xFirst)));
      }
      if (!planes.HasRow(rows[j]) || sites->begin == sites->end)
      {
        store(index, 0, nullptr);
        continue;
      }
      const SizeValueType first = yTaps.GetFirst(j);
      blendedRows.Advance(first, first + yCount, [&](SizeValueType y, float * blended) { blendSlices(k, y, blended); });
      for (SizeValueType tap = 0; tap < yCount; ++tap)
      {
        terms[tap] = blendedRows.GetRow(first + tap);
      }
      RowArithmetic::Blend(terms.data(), yTaps.GetWeights(j), yCount, xCount, row.data());
      values.resize(sites->taps.GetPaddedLength());
      RowArithmetic::Interpolate(row.data(), sites->taps, values.data());
      index[0] += static_cast<IndexValueType>(sites->begin);
      store(index, sites->end - sites->begin, values.data() + sites->begin);
    }
  }
}

} // namespace

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

CartesianToFCCRows::RegionType
CartesianToFCCRows::FindNeededSamples(const RegionType & sites) const
{
  RegionType needed;
  if (m_Stack)
  {
    needed = SliceStackPlanes(*m_Stack, m_Kernel, m_Volume, m_Lattice, sites).FindNeededSamples();
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
    ResampleStackRows({ *m_Stack, m_Kernel, m_Volume, m_Lattice, sites }, sites, loadFromVolume, store);
  }
  else
  {
    const SeparableTaps xTaps[2] = { this->MakeTaps(0, sites, 0), this->MakeTaps(0, sites, 1) };
    ResampleRows(xTaps, this->MakeTaps(1, sites), this->MakeTaps(2, sites), sites, loadFromVolume, store);
  }
}

} // namespace itk
