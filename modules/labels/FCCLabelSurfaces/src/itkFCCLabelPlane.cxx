#include "itkFCCLabelPlane.h"

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

FCCLabelBox::Plane::Plane(const FCCLabelBox & box, SizeValueType k)
  : m_Stride(box.GetNumberOfWords() * FCCBits::WordBits + 2)
  , m_Labels(box.GetHeight() * m_Stride)
{
  for (SizeValueType j = 0; j < box.GetHeight(); ++j)
  {
    SizeValueType row = 0;
    if (box.FindImageRow(j, k, row))
    {
      const SizeValueType width = box.m_ImageSize[0];
      std::copy_n(box.m_Labels + row * width, width, m_Labels.data() + j * m_Stride + 2);
    }
  }
}

FCCLabelPlane::FCCLabelPlane(const FCCLabelBox & box)
  : m_Box(box)
  , m_Bits(box.GetHeight() * FCCCells::Types, box.GetNumberOfWords(), std::pmr::get_default_resource())
{}

void
FCCLabelPlane::FindEdges(SizeValueType k, const FCCLabelBox::Plane & labels, const FCCLabelBox::Plane & next)
{
  m_K = k;
  m_Bits.Clear();
  for (SizeValueType j = 0; j < m_Box.GetHeight(); ++j)
  {
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
      }
    }
  }
}

void
FCCLabelPlane::FindFacesAndTetrahedra(const FCCLabelPlane & next)
{
  for (SizeValueType j = 0; j < m_Box.GetHeight(); ++j)
  {
    for (unsigned int type = FCCCells::FirstFace; type < FCCCells::Types; ++type)
    {
      if (!m_Box.HasSimplices(j, m_K, type))
      {
        continue;
      }
      FCCBits::WordType * const bits = m_Bits.GetRow(j * FCCCells::Types + type);
      std::fill_n(bits, m_Box.GetNumberOfWords(), ~FCCBits::WordType{ 0 });
      for (unsigned int set = 1; set < 1u << FCCCells::Simplices[type].size; ++set)
      {
        if (FCCCells::SizeOf(set) == 2)
        {
          const FCCLabelPart cut(m_Box, *this, next, j, type, set);
          for (SizeValueType word = 0; word < m_Box.GetNumberOfWords(); ++word)
          {
            bits[word] &= cut.GetBits(word);
          }
        }
      }
    }
  }
}

FCCLabelPart::FCCLabelPart(const FCCLabelBox & box,
                           const FCCLabelPlane & plane,
                           const FCCLabelPlane & next,
                           SizeValueType j,
                           unsigned int type,
                           unsigned int set)
{
  const FCCCells::Simplex & simplex = FCCCells::Simplices[type];
  const FCCCells::Part & part = simplex.parts[set];
  const FCCLattice::SiteType & step = simplex.steps[part.site];
  row = (step[2] == 0 ? plane : next).GetRow(j + static_cast<SizeValueType>(step[1]), part.type);
  shift = FCCLattice::OffsetOf(step, box.GetParity(j, plane.GetPlane()))[0];
}

} // namespace itk
