#include "itkFCCLabelWeights.h"

#include "rhombicBulkResource.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace itk
{

void
FCCLabelWeights::SetNumberOfRows(SizeValueType rows)
{
  this->Initialize();
  m_Memory = rhombic::ResourceForSmallArrays();
  m_Rows.reserve(rows);
  m_Begins.reserve(rows);
  for (SizeValueType row = 0; row < rows; ++row)
  {
    m_Rows.emplace_back(m_Memory.get());
    m_Begins.emplace_back(m_Memory.get());
  }
}

void
FCCLabelWeights::SortRow(SizeValueType row)
{
  // By counting: labels were added one after another, so that their order at a site is nearly right.
  RowType & entries = m_Rows[row];
  std::vector<std::uint32_t> places(1);
  for (const Entry & entry : entries)
  {
    places.resize(std::max<std::size_t>(places.size(), entry.i + std::size_t{ 2 }));
    ++places[entry.i + std::size_t{ 1 }];
  }
  std::partial_sum(places.begin(), places.end(), places.begin());
  BeginsType & begins = m_Begins[row];
  begins.clear();
  for (std::size_t i = 0; i < places.size(); i += SitesPerBegin)
  {
    begins.push_back(places[i]);
  }
  begins.back() != entries.size() ? begins.push_back(places.back()) : void();
  RowType sorted(entries.size(), entries.get_allocator());
  for (const Entry & entry : entries)
  {
    sorted[places[entry.i]++] = entry;
  }
  for (std::size_t n = 1; n < sorted.size(); ++n)
  {
    for (std::size_t m = n; m > 0 && sorted[m - 1].i == sorted[m].i && sorted[m - 1].label > sorted[m].label; --m)
    {
      std::swap(sorted[m - 1], sorted[m]);
    }
  }
  entries.swap(sorted);
}

const float *
FCCLabelWeights::Find(SizeValueType row, std::uint32_t i, LabelType label) const
{
  const BeginsType & begins = m_Begins[row];
  const std::uint32_t place = i / SitesPerBegin;
  if (place + 1 >= begins.size())
  {
    return nullptr;
  }
  const auto end = m_Rows[row].begin() + begins[place + 1];
  const auto found = std::find_if(m_Rows[row].begin() + begins[place], end, [&](const Entry & entry) {
    return entry.i == i && entry.label == label;
  });
  return found != end ? &found->weight : nullptr;
}

SizeValueType
FCCLabelWeights::GetNumberOfWeights() const
{
  SizeValueType count = 0;
  for (const RowType & row : m_Rows)
  {
    count += row.size();
  }
  return count;
}

void
FCCLabelWeights::Initialize()
{
  Superclass::Initialize();
  BulkVector<RowType>().swap(m_Rows);
  BulkVector<BeginsType>().swap(m_Begins);
  m_Memory.reset();
}

void
FCCLabelWeights::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRows: " << m_Rows.size() << std::endl;
  os << indent << "NumberOfWeights: " << this->GetNumberOfWeights() << std::endl;
}

} // namespace itk
