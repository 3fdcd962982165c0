#include "itkFCCFieldPlanes.h"

#include "itkFCCCells.h"

#include <algorithm>

namespace itk
{
namespace
{

/** Writes one bit for each site of a row of the signs: has it a neighbour on the other side of the surface? */
void
FindBorderSites(const FCCSigns & signs, SizeValueType j, SizeValueType k, FCCSigns::WordType * border)
{
  const FCCSigns::WordType * const row = signs.GetRow(j, k);
  std::fill_n(border, signs.GetNumberOfWords(), 0);
  for (unsigned int direction = 0; direction < FCCCells::Directions; ++direction)
  {
    const FCCStepTarget end(signs, j, k, FCCCells::StepOf(direction));
    if (end.isInBox)
    {
      FCCBits::ForEachShifted(signs.GetRow(end.j, end.k),
                              signs.GetNumberOfWords(),
                              end.shift,
                              [&](SizeValueType word, FCCSigns::WordType bits) { border[word] |= row[word] ^ bits; });
    }
  }
}

} // namespace

FCCFieldPlanes::FCCFieldPlanes(const FCCSigns & signs, const FCCScalarField & field, SizeValueType planesOfGradients)
  : m_Signs(signs)
  , m_Size{ field.region.GetSize(0) + 2, field.region.GetSize(1) + 2, field.region.GetSize(2) + 2 }
  , m_ParityOfFirstRow(FCCLattice::Parity(field.region.GetIndex(1) - 1, field.region.GetIndex(2) - 1))
  , m_ReadRow(field.readRow)
{
  const auto addPlanes = [&field](std::vector<Plane> & planes, SizeValueType count) {
    planes.reserve(count);
    for (SizeValueType n = 0; n < count; ++n)
    {
      planes.emplace_back(field.scratch);
    }
  };
  addPlanes(m_Values, 6);
  addPlanes(m_Coefficients, 3);
  m_Gradients.reserve(planesOfGradients);
  for (SizeValueType n = 0; n < planesOfGradients; ++n)
  {
    m_Gradients.emplace_back(FCCNumberedBits(m_Size[1], FCCBits::WordsOf(m_Size[0]), field.scratch));
  }
  constexpr SizeValueType block = FCCFieldKernels::Block;
  m_Stride = FCCBits::WordsOf(m_Size[0]) * FCCBits::WordBits + 2 * block; // rows are also read by words of signs
}

template <typename TFill>
void
FCCFieldPlanes::LoadPlane(std::vector<Plane> & planes, SizeValueType k, const TFill & fill) const
{
  Plane & plane = planes[k % planes.size()];
  if (plane.number == k)
  {
    return;
  }
  plane.samples.resize(m_Stride * m_Size[1]);
  plane.number = k;
  if (this->IsReal(2, k))
  {
    fill(plane);
    this->ExtrapolateWithin(plane, k);
    return;
  }
  const bool isFirst = k == 0;
  this->LoadPlane(planes, isFirst ? 1 : k - 1, fill);
  if (m_Size[2] > 3)
  {
    this->LoadPlane(planes, isFirst ? 2 : k - 2, fill);
  }
  this->ExtrapolatePlane(planes, k);
}

void
FCCFieldPlanes::LoadValues(SizeValueType k)
{
  this->LoadPlane(m_Values, k, [this](Plane & plane) {
    for (SizeValueType j = 1; j + 1 < m_Size[1]; ++j)
    {
      m_ReadRow(j - 1, plane.number - 1, plane.GetRow(j, m_Stride) + 1);
    }
  });
}

void
FCCFieldPlanes::LoadValuesAround(SizeValueType k)
{
  for (SizeValueType near = k > 0 ? k - 1 : 0; near < std::min(k + 2, m_Size[2]); ++near)
  {
    this->LoadValues(near);
  }
}

void
FCCFieldPlanes::LoadCoefficients(SizeValueType k)
{
  this->LoadPlane(m_Coefficients, k, [this](Plane & plane) {
    this->LoadValuesAround(plane.number);
    for (SizeValueType j = 1; j + 1 < m_Size[1]; ++j)
    {
      FCCFieldKernels::QuasiInterpolate(this->GetValues(j, plane.number),
                                        this->GetNeighborRows(m_Values, j, plane.number),
                                        m_Size[0],
                                        plane.GetRow(j, m_Stride));
    }
  });
}

void
FCCFieldPlanes::LoadGradients(SizeValueType k)
{
  GradientPlane & plane = m_Gradients[k % m_Gradients.size()];
  if (plane.number == k || !this->IsReal(2, k))
  {
    return;
  }
  for (SizeValueType near = k - 1; near <= k + 1; ++near)
  {
    this->LoadCoefficients(near);
  }
  plane.number = k;
  this->FindSites(k, plane.sites);
  plane.gradients.resize(FCCFieldKernels::GradientStride * plane.sites.Number(0));
  for (SizeValueType j = 1; j + 1 < m_Size[1]; ++j)
  {
    const FCCNumberedBits::Row row = plane.sites.GetNumberedRow(j);
    FCCFieldKernels::Gradient(this->GetNeighborRows(m_Coefficients, j, k),
                              row.bits,
                              plane.sites.GetStride() - 1,
                              plane.gradients.data() + FCCFieldKernels::GradientStride * row.numberOfWord[0]);
  }
}

void
FCCFieldPlanes::FindSites(SizeValueType k, FCCNumberedBits & sites) const
{
  const SizeValueType margin = (m_Size[0] - m_Signs.GetWidth()) / 2; // sites around those that have signs
  for (SizeValueType j = 1; j + 1 < m_Size[1]; ++j)
  {
    FCCSigns::WordType * const row = sites.GetRow(j);
    FindBorderSites(m_Signs, j - margin, k - margin, row);
    if (margin > 0)
    {
      row[m_Signs.GetNumberOfWords()] = 0;
      FCCBits::MoveUp(row, sites.GetStride() - 1);
    }
  }
}

/** The layer around the image, in a plane whose real sites are known: the ends of rows, then the rows beyond. */
void
FCCFieldPlanes::ExtrapolateWithin(Plane & plane, SizeValueType k) const
{
  const SizeValueType last = m_Size[0] - 1;
  for (SizeValueType j = 1; j + 1 < m_Size[1]; ++j)
  {
    float * const row = plane.GetRow(j, m_Stride);
    row[0] = last > 2 ? 2.0f * row[1] - row[2] : row[1];
    row[last] = last > 2 ? 2.0f * row[last - 1] - row[last - 2] : row[1];
  }
  const SizeValueType end = m_Size[1] - 1;
  const bool isThick = end > 2;
  this->ExtrapolateRow(plane.GetRow(1, m_Stride),
                       isThick ? plane.GetRow(2, m_Stride) : nullptr,
                       this->GetParity(0, k),
                       plane.GetRow(0, m_Stride));
  this->ExtrapolateRow(plane.GetRow(end - 1, m_Stride),
                       isThick ? plane.GetRow(end - 2, m_Stride) : nullptr,
                       this->GetParity(end, k),
                       plane.GetRow(end, m_Stride));
}

/** A whole plane beyond the image, from the two next to it. */
void
FCCFieldPlanes::ExtrapolatePlane(std::vector<Plane> & planes, SizeValueType k) const
{
  const SizeValueType near = k == 0 ? 1 : k - 1;
  const SizeValueType far = k == 0 ? 2 : k - 2;
  const bool isThick = m_Size[2] > 3;
  for (SizeValueType j = 0; j < m_Size[1]; ++j)
  {
    this->ExtrapolateRow(planes[near % planes.size()].GetRow(j, m_Stride),
                         isThick ? planes[far % planes.size()].GetRow(j, m_Stride) : nullptr,
                         this->GetParity(j, k),
                         planes[k % planes.size()].GetRow(j, m_Stride));
  }
}

/** Sites two rows apart lie on a line through the middle of two neighbours in the row between. */
void
FCCFieldPlanes::ExtrapolateRow(const float * near, const float * far, IndexValueType parity, float * row) const
{
  const auto last = static_cast<IndexValueType>(m_Size[0]) - 1;
  const auto nearAt = [near, last](IndexValueType i) {
    return i < 0 ? 2.0f * near[0] - near[1] : i > last ? 2.0f * near[last] - near[last - 1] : near[i];
  };
  for (IndexValueType i = 0; i <= last; ++i)
  {
    const float before = nearAt(i + parity - 1);
    const float after = nearAt(i + parity);
    row[i] = far != nullptr ? (before + after) - far[i] : 0.5f * (before + after);
  }
}

FCCFieldKernels::NeighborRows
FCCFieldPlanes::GetNeighborRows(const std::vector<Plane> & planes, SizeValueType j, SizeValueType k) const
{
  FCCFieldKernels::NeighborRows rows;
  for (std::size_t n = 0; n < rows.size(); ++n)
  {
    rows[n] = this->GetRow(planes, j, k, FCCLattice::NearestNeighbors[n]);
  }
  return rows;
}

} // namespace itk
