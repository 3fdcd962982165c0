#include "itkFCCSiteStar.h"

namespace itk
{

const FCCSiteStar &
FCCSiteStar::Get()
{
  static const FCCSiteStar star;
  return star;
}

FCCSiteStar::FCCSiteStar()
{
  this->FindEdges();
  this->FindTetrahedra();
  this->FindDisks();
}

void
FCCSiteStar::FindEdges()
{
  std::uint8_t count = 0;
  for (std::uint8_t a = 0; a < Sites; ++a)
  {
    for (std::uint8_t b = 0; b < a; ++b)
    {
      const auto direction = static_cast<std::uint8_t>(DirectionOf(FCCStep::Subtract(StepTo(b), StepTo(a))));
      if (direction == NoDirection)
      {
        continue;
      }
      const auto opposite = static_cast<std::uint8_t>(OppositeOf(direction));
      m_EdgeBetween[a][b] = m_EdgeBetween[b][a] = count;
      m_EdgesAt[a] |= std::uint64_t{ 1 } << count;
      m_EdgesAt[b] |= std::uint64_t{ 1 } << count;
      m_Edges[count++] = direction < StoredDirections ? Edge{ { a, b }, { direction, opposite } }
                                                      : Edge{ { b, a }, { opposite, direction } };
      if (a != Center)
      {
        m_Adjacent[a] |= 1U << b;
        m_Adjacent[b] |= 1U << a;
      }
    }
  }
}

void
FCCSiteStar::FindTetrahedra()
{
  std::size_t count = 0;
  for (std::uint8_t a = 0; a < Directions; ++a)
  {
    for (std::uint8_t b = 0; b < a; ++b)
    {
      for (std::uint8_t c = 0; c < b; ++c)
      {
        if ((m_Adjacent[a] >> b & m_Adjacent[a] >> c & m_Adjacent[b] >> c & 1) == 0)
        {
          continue;
        }
        Tetrahedron & tetrahedron = m_Tetrahedra[count++];
        tetrahedron = { { Center, a, b, c }, 1U << a | 1U << b | 1U << c, {}, false, {} };
        tetrahedron.isBelow = StepTo(a)[2] < 0 || StepTo(b)[2] < 0 || StepTo(c)[2] < 0;
        for (unsigned int pattern = 0; pattern < 16; ++pattern)
        {
          tetrahedron.polygons[pattern] =
            FCCTetrahedronPolygon::Of({ StepTo(Center), StepTo(a), StepTo(b), StepTo(c) }, pattern);
          for (unsigned int n = 0; n < tetrahedron.polygons[pattern].size; ++n)
          {
            const auto [inside, outside] = tetrahedron.polygons[pattern].crossings[n];
            tetrahedron.edges[pattern][n] = m_EdgeBetween[tetrahedron.sites[inside]][tetrahedron.sites[outside]];
          }
        }
      }
    }
  }
}

void
FCCSiteStar::FindDisks()
{
  for (unsigned int set = 1; set < 1U << Directions; ++set)
  {
    auto characteristic = __builtin_popcount(set); // points - sides + triangles
    for (const Edge & edge : m_Edges)
    {
      characteristic -= edge.ends[0] != Center && (set >> edge.ends[0] & set >> edge.ends[1] & 1) != 0 ? 1 : 0;
    }
    for (const Tetrahedron & tetrahedron : m_Tetrahedra)
    {
      characteristic += (set & tetrahedron.far) == tetrahedron.far ? 1 : 0;
    }
    m_IsDisk[set] = characteristic == 1 && this->PartOf(set, static_cast<unsigned int>(__builtin_ctz(set))) == set;
  }
}

unsigned int
FCCSiteStar::PartOf(unsigned int set, unsigned int direction) const
{
  unsigned int part = 1U << direction;
  for (unsigned int added = part; added != 0;)
  {
    unsigned int next = 0;
    for (; added != 0; added &= added - 1)
    {
      next |= m_Adjacent[static_cast<unsigned int>(__builtin_ctz(added))];
    }
    added = next & set & ~part;
    part |= added;
  }
  return part;
}

} // namespace itk
