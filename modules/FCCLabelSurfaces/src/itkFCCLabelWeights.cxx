#include "itkFCCLabelWeights.h"

#include <algorithm>

namespace itk
{
namespace
{

bool
IsBefore(const FCCLabelWeights::Entry & a, const FCCLabelWeights::Entry & b)
{
  return a.i != b.i ? a.i < b.i : a.label < b.label;
}

} // namespace

void
FCCLabelWeights::SetNumberOfRows(SizeValueType rows)
{
  m_Rows.clear();
  m_Rows.resize(rows);
}

void
FCCLabelWeights::SortRow(SizeValueType row)
{
  std::sort(m_Rows[row].begin(), m_Rows[row].end(), IsBefore);
  m_Rows[row].shrink_to_fit();
}

const float *
FCCLabelWeights::Find(SizeValueType row, std::uint32_t i, LabelType label) const
{
  const Entry sought{ i, label, 0.0f };
  const auto found = std::lower_bound(m_Rows[row].begin(), m_Rows[row].end(), sought, IsBefore);
  return found != m_Rows[row].end() && found->i == i && found->label == label ? &found->weight : nullptr;
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
}

void
FCCLabelWeights::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfRows: " << m_Rows.size() << std::endl;
  os << indent << "NumberOfWeights: " << this->GetNumberOfWeights() << std::endl;
}

} // namespace itk
