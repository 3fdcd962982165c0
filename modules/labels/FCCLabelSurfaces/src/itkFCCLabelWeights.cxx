#include "itkFCCLabelWeights.h"

#include <algorithm>

namespace itk
{

void
FCCLabelWeights::SetNumberOfRows(SizeValueType rows)
{
  m_Rows.clear();
  m_Rows.resize(rows);
  m_Begins.clear();
  m_Begins.resize(rows);
}

void
FCCLabelWeights::SortRow(SizeValueType row)
{
  RowType & entries = m_Rows[row];
  std::sort(entries.begin(), entries.end(), [](const Entry & a, const Entry & b) {
    return a.i != b.i ? a.i < b.i : a.label < b.label;
  });
  entries.shrink_to_fit();
  std::vector<std::uint32_t> & begins = m_Begins[row];
  begins.clear();
  for (std::uint32_t n = 0; n < entries.size(); ++n)
  {
    begins.resize(std::max<std::size_t>(begins.size(), entries[n].i / SitesPerBegin + 1), n);
  }
  begins.push_back(static_cast<std::uint32_t>(entries.size()));
}

const float *
FCCLabelWeights::Find(SizeValueType row, std::uint32_t i, LabelType label) const
{
  const std::vector<std::uint32_t> & begins = m_Begins[row];
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
  std::vector<RowType>().swap(m_Rows);
  m_Begins.clear();
}

void
FCCLabelWeights::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRows: " << m_Rows.size() << std::endl;
  os << indent << "NumberOfWeights: " << this->GetNumberOfWeights() << std::endl;
}

} // namespace itk
