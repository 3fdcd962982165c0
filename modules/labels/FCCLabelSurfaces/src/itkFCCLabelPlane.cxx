#include "itkFCCLabelPlane.h"

#include <algorithm>

namespace itk
{

bool
FCCLabelBox::HasSimplices(SizeValueType j, SizeValueType k, unsigned int type) const
{
  bool isIn = true;
  for (const auto & step : FCCCells::Simplices[type].steps)
  {
    isIn = isIn && j + static_cast<SizeValueType>(step[1]) < this->GetHeight() && // below 0 wraps around
           k + static_cast<SizeValueType>(step[2]) < this->GetDepth();
  }
  return isIn;
}

FCCLabelBox::LabelType
FCCLabelBox::GetLabel(const Index<3> & site) const
{
  SizeValueType row = 0;
  return this->FindImageRow(site, row)
           ? m_Image.GetBufferPointer()[row * m_Region.GetSize(0) + static_cast<SizeValueType>(site[0] - 1)]
           : 0;
}

TriangleSurface::PointType
FCCLabelBox::GetPoint(const Index<3> & index, const PositionType & steps) const
{
  const Index<3> & first = m_Region.GetIndex();
  const FCCLattice::SiteType site =
    FCCLattice::SiteOf({ { first[0] + index[0] - 1, first[1] + index[1] - 1, first[2] + index[2] - 1 } });
  const auto point = m_Image.TransformLatticeToPhysicalPoint<double>(
    Add({ static_cast<double>(site[0]), static_cast<double>(site[1]), static_cast<double>(site[2]) }, steps));
  return ToPoint({ point[0], point[1], point[2] });
}

FCCLabelBox::Plane::Plane(const FCCLabelBox & box, SizeValueType k)
  : m_Stride(box.GetNumberOfWords() * FCCBits::WordBits + 2)
  , m_Labels(box.GetHeight() * m_Stride)
{
  for (SizeValueType j = 0; j < box.GetHeight(); ++j)
  {
    SizeValueType row = 0;
    if (box.FindImageRow(j, k, row))
    {
      const SizeValueType width = box.m_Region.GetSize(0);
      std::copy_n(box.m_Image.GetBufferPointer() + row * width, width, m_Labels.data() + j * m_Stride + 2);
    }
  }
}

FCCLabelPlane::FCCLabelPlane(const FCCLabelBox & box)
  : m_Box(box)
  , m_Bits(box.GetHeight() * FCCCells::Types, box.GetNumberOfWords(), std::pmr::get_default_resource())
  , m_HasCutEdges(box.GetHeight())
{}

void
FCCLabelPlane::FindEdges(SizeValueType k, const FCCLabelBox::Plane & labels, const FCCLabelBox::Plane & next)
{
  m_K = k;
  m_Bits.Clear();
  for (SizeValueType j = 0; j < m_Box.GetHeight(); ++j)
  {
    FCCBits::WordType any = 0;
    for (unsigned int type = 0; type < FCCCells::Edges; ++type)
    {
      if (!m_Box.HasSimplices(j, k, type))
      {
        continue;
      }
      const FCCLattice::SiteType & step = FCCLattice::OwnedEdges[type];
      const FCCLabelBox::LabelType * const starts = labels.GetRow(j);
      const FCCLabelBox::LabelType * const ends =
        (step[2] == 0 ? labels : next).GetRow(j + static_cast<SizeValueType>(step[1])) +
        FCCLattice::OffsetOf(step, m_Box.GetParity(j, k))[0];
      FCCBits::WordType * const bits = m_Bits.GetRow(j * FCCCells::Types + type);
      for (SizeValueType word = 0; word < m_Box.GetNumberOfWords(); ++word)
      {
        const SizeValueType first = word * FCCBits::WordBits;
        bits[word] = FCCBits::Pack([=](SizeValueType n) { return starts[first + n] != ends[first + n]; });
        any |= bits[word];
      }
    }
    m_HasCutEdges[j] = any != 0 ? 1 : 0;
  }
}

bool
FCCLabelPlane::MayHavePoints(const FCCLabelPlane & next, SizeValueType j) const
{
  const SizeValueType first = std::max<SizeValueType>(j, 1) - 1; // simplices reach to the rows beside theirs
  const SizeValueType last = std::min(j + 1, m_Box.GetHeight() - 1);
  bool hasCutEdges = false;
  for (SizeValueType row = first; row <= last; ++row)
  {
    hasCutEdges = hasCutEdges || m_HasCutEdges[row] != 0 || next.m_HasCutEdges[row] != 0;
  }
  return hasCutEdges;
}

void
FCCLabelPlane::FindFacesAndTetrahedra(const FCCLabelPlane & next)
{
  for (SizeValueType j = 0; j < m_Box.GetHeight(); ++j)
  {
    const bool mayHavePoints = this->MayHavePoints(next, j);
    for (unsigned int type = FCCCells::FirstFace; type < FCCCells::Types; ++type)
    {
      if (!mayHavePoints || !m_Box.HasSimplices(j, m_K, type))
      {
        continue;
      }
      FCCBits::WordType * const bits = m_Bits.GetRow(j * FCCCells::Types + type);
      std::fill_n(bits, m_Box.GetNumberOfWords(), ~FCCBits::WordType{ 0 });
      for (unsigned int set = 1; set < 1u << FCCCells::Simplices[type].size; ++set)
      {
        if (FCCCells::SizeOf(set) == 2)
        {
          const FCCLabelPart cut = this->GetPart(next, j, type, set);
          for (SizeValueType word = 0; word < m_Box.GetNumberOfWords(); ++word)
          {
            bits[word] &= cut.GetBits(word);
          }
        }
      }
    }
  }
}

FCCLabelPart
FCCLabelPlane::GetPart(const FCCLabelPlane & next, SizeValueType j, unsigned int type, unsigned int set) const
{
  const FCCCells::Simplex & simplex = FCCCells::Simplices[type];
  const FCCCells::Part & part = simplex.parts[set];
  const FCCLattice::SiteType & step = simplex.steps[part.site];
  return { (step[2] == 0 ? *this : next).GetRow(j + static_cast<SizeValueType>(step[1]), part.type),
           FCCLattice::OffsetOf(step, m_Box.GetParity(j, m_K))[0] };
}

} // namespace itk
