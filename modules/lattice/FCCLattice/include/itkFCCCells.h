#ifndef itkFCCCells_h
#define itkFCCCells_h

#include "itkFCCLattice.h"

#include <bitset>
#include <cstdint>

namespace itk
{

/** \class FCCStep
 * \brief Arithmetic of sites and of the steps between them, at compile time.
 *
 * \ingroup FCCLattice
 */
struct FCCStep
{
  using SiteType = FCCLattice::SiteType;

  /** a + b. */
  static constexpr SiteType
  Add(const SiteType & a, const SiteType & b)
  {
    return { a[0] + b[0], a[1] + b[1], a[2] + b[2] };
  }

  /** a - b. */
  static constexpr SiteType
  Subtract(const SiteType & a, const SiteType & b)
  {
    return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
  }

  /** A multiple of a step. */
  static constexpr SiteType
  Multiply(IndexValueType factor, const SiteType & step)
  {
    return { factor * step[0], factor * step[1], factor * step[2] };
  }

  /** Whether all three indices are equal. */
  static constexpr bool
  AreEqual(const SiteType & a, const SiteType & b)
  {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
  }

  /** Squared length in units of the indices. */
  static constexpr IndexValueType
  SquaredLength(const SiteType & step)
  {
    return step[0] * step[0] + step[1] * step[1] + step[2] * step[2];
  }

  /** Cross product of two steps. */
  static constexpr SiteType
  Cross(const SiteType & a, const SiteType & b)
  {
    return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
  }

  /** Six times the signed volume of the tetrahedron of four sites: negative when \a d lies below the plane of the
   * others, which are counter-clockwise seen from above. */
  static constexpr IndexValueType
  Orientation(const SiteType & a, const SiteType & b, const SiteType & c, const SiteType & d)
  {
    const SiteType normal = Cross(Subtract(b, a), Subtract(c, a));
    const SiteType step = Subtract(d, a);
    return normal[0] * step[0] + normal[1] * step[1] + normal[2] * step[2];
  }

  /** Whether a site comes before another by z, then y, then x. */
  static constexpr bool
  IsLower(const SiteType & a, const SiteType & b)
  {
    return a[2] != b[2] ? a[2] < b[2] : a[1] != b[1] ? a[1] < b[1] : a[0] < b[0];
  }
};

/** \class FCCCells
 * \brief The tetrahedra of the lattice with their faces and edges, and the neighbours of a site among them.
 *
 * The lattice's Delaunay cells (see FCCLattice) are cut into tetrahedra of equal volume: the *regular* tetrahedron in
 * each unit cube is one of them, and the octahedron around each odd point is cut into four *quarters* about its
 * diagonal along x. Each edge of a tetrahedron is a step of FCCLattice::OwnedEdges or its opposite.
 *
 * A *simplex* is an edge, a face or a tetrahedron. It is *stored* by its lowest site (see FCCStep::IsLower()), as one
 * of 25 *types*: 7 edges, 12 faces and 6 tetrahedra.
 *
 * The *neighbours* of a site are the other ends of its 14 edges. *Directions* lead to them: 0 to 6 are the steps of
 * FCCLattice::OwnedEdges, along edges that the site stores, and 7 to 13 are the opposites of these, along edges that
 * neighbours store. Sets of directions are bits. The *link* of a site is the sphere around it: the 14 neighbours, 36
 * edges and 24 triangles between these, with which the site forms 24 tetrahedra.
 *
 * The compiler derives all tables here from the definitions above.
 *
 * \ingroup FCCLattice
 */
struct FCCCells
{
  using SiteType = FCCLattice::SiteType;

  static constexpr unsigned int Edges = FCCLattice::OwnedEdges.size();
  static constexpr unsigned int Faces = 12;
  static constexpr unsigned int Tetrahedra = 6;
  static constexpr unsigned int FirstFace = Edges;
  static constexpr unsigned int FirstTetrahedron = Edges + Faces;
  static constexpr unsigned int Types = Edges + Faces + Tetrahedra;

  /** A simplex within another simplex. */
  struct Part
  {
    std::uint8_t site = 0; ///< which site of the other simplex is the lowest of the part
    std::uint8_t type = 0;
  };

  /** An edge, face or tetrahedron of the lattice's cells. */
  struct Simplex
  {
    std::uint8_t size = 0;
    SiteType steps[4] = {};  ///< from the lowest site to all sites, ascending; the first is 0
    Part parts[16] = {};     ///< by the set of the part's sites, bit n for the n-th; from two sites on
    bool isPositive = false; ///< whether FCCStep::Orientation() of a tetrahedron's sites is
  };

  /** The simplices that a site stores: edges in the order of FCCLattice::OwnedEdges, faces, tetrahedra. The
   * first two tetrahedra are the regular ones, in the unit cubes after and before the site. */
  static const std::array<Simplex, Types> Simplices;

  /** The number of members of a set of at most four sites. */
  static constexpr unsigned int
  SizeOf(unsigned int set)
  {
    return (set & 1) + (set >> 1 & 1) + (set >> 2 & 1) + (set >> 3 & 1);
  }

  static constexpr unsigned int Directions = 2 * Edges;
  static constexpr unsigned int AllDirections = (1u << Directions) - 1;

  /** The step to the neighbour in a direction, below Directions. */
  static constexpr SiteType
  StepOf(unsigned int direction)
  {
    return FCCStep::Multiply(direction < Edges ? 1 : -1, FCCLattice::OwnedEdges[direction % Edges]);
  }

  /** The direction of a step to a neighbour; Directions for other steps. */
  static constexpr unsigned int
  DirectionOf(const SiteType & step)
  {
    unsigned int direction = 0;
    while (direction < Directions && !FCCStep::AreEqual(StepOf(direction), step))
    {
      ++direction;
    }
    return direction;
  }

  /** The direction back from the neighbour in a direction. */
  static constexpr unsigned int
  OppositeOf(unsigned int direction)
  {
    return (direction + Edges) % Directions;
  }

  /** By direction: the neighbours that are also neighbours of that neighbour, joined with it by an edge of the link. */
  static const std::array<unsigned int, Directions> Adjacent;

  /** The neighbours of a set that are connected with one of its members by edges of the link between members. */
  static constexpr unsigned int
  PartOf(unsigned int set, unsigned int direction);

  /** Whether the neighbours of a set, with the edges and triangles of the link between them, form a disk. On a sphere
   * a set forms a disk if it and the rest are connected, and neither is empty. */
  static bool
  IsDisk(unsigned int set);

private:
  /** A simplex of some of another's sites, bit n for the n-th. Sites must be ascending. */
  static constexpr Simplex
  SimplexOf(const Simplex & whole, unsigned int set)
  {
    Simplex simplex;
    SiteType lowest{};
    for (unsigned int n = 0; n < whole.size; ++n)
    {
      if ((set >> n & 1) != 0)
      {
        lowest = simplex.size == 0 ? whole.steps[n] : lowest;
        simplex.steps[simplex.size++] = FCCStep::Subtract(whole.steps[n], lowest);
      }
    }
    return simplex;
  }

  static constexpr Simplex
  TetrahedronOf(const SiteType (&sites)[4])
  {
    Simplex ordered;
    for (const SiteType & site : sites)
    {
      unsigned int place = ordered.size++;
      for (; place > 0 && FCCStep::IsLower(site, ordered.steps[place - 1]); --place)
      {
        ordered.steps[place] = ordered.steps[place - 1];
      }
      ordered.steps[place] = site;
    }
    Simplex tetrahedron = SimplexOf(ordered, 15);
    const auto & steps = tetrahedron.steps;
    tetrahedron.isPositive = FCCStep::Orientation(steps[0], steps[1], steps[2], steps[3]) > 0;
    return tetrahedron;
  }

  /** The regular tetrahedra in the unit cubes after and before a site, then the quarters of an octahedron in turn. */
  static constexpr std::array<Simplex, Tetrahedra>
  MakeTetrahedra()
  {
    constexpr IndexValueType quarters[4][2] = { { 1, 1 }, { -1, 1 }, { -1, -1 }, { 1, -1 } }; // in y and z
    std::array<Simplex, Tetrahedra> tetrahedra;
    tetrahedra[0] = TetrahedronOf({ { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 1 }, { 0, 1, 1 } });
    tetrahedra[1] = TetrahedronOf({ { 0, 0, 0 }, { -1, 1, 0 }, { -1, 0, 1 }, { 0, 1, 1 } });
    for (unsigned int n = 0; n < 4; ++n)
    {
      tetrahedra[2 + n] =
        TetrahedronOf({ { 0, 0, 0 }, { 2, 0, 0 }, { 1, quarters[n][0], 0 }, { 1, 0, quarters[n][1] } });
    }
    return tetrahedra;
  }

  static constexpr bool
  AreEqual(const Simplex & a, const Simplex & b)
  {
    bool equal = a.size == b.size;
    for (unsigned int n = 0; n < 4; ++n)
    {
      equal = equal && FCCStep::AreEqual(a.steps[n], b.steps[n]);
    }
    return equal;
  }

  /** The type of a simplex, or Types if it is not in the table yet. */
  static constexpr unsigned int
  FindType(const std::array<Simplex, Types> & simplices, const Simplex & simplex)
  {
    unsigned int type = 0;
    while (type < Types && !AreEqual(simplices[type], simplex))
    {
      ++type;
    }
    return type;
  }

  static constexpr std::array<Simplex, Types>
  MakeSimplices()
  {
    std::array<Simplex, Types> simplices;
    unsigned int types = 0;
    for (const SiteType & step : FCCLattice::OwnedEdges)
    {
      simplices[types].size = 2;
      simplices[types++].steps[1] = step;
    }
    constexpr auto tetrahedra = MakeTetrahedra();
    for (const Simplex & tetrahedron : tetrahedra)
    {
      for (unsigned int set = 1; set < 16; ++set)
      {
        const Simplex face = SimplexOf(tetrahedron, set);
        if (face.size == 3 && FindType(simplices, face) == Types)
        {
          simplices[types++] = face;
        }
      }
    }
    for (const Simplex & tetrahedron : tetrahedra)
    {
      simplices[types++] = tetrahedron;
    }
    for (Simplex & simplex : simplices)
    {
      for (unsigned int set = 1; set < 1u << simplex.size; ++set)
      {
        const unsigned int lowest = (set & 1) != 0 ? 0 : (set & 2) != 0 ? 1 : 2;
        if (SizeOf(set) >= 2)
        {
          simplex.parts[set] = { static_cast<std::uint8_t>(lowest),
                                 static_cast<std::uint8_t>(FindType(simplices, SimplexOf(simplex, set))) };
        }
      }
    }
    return simplices;
  }

  static constexpr std::array<unsigned int, Directions>
  MakeAdjacent()
  {
    std::array<unsigned int, Directions> adjacent{};
    for (unsigned int a = 0; a < Directions; ++a)
    {
      for (unsigned int b = 0; b < Directions; ++b)
      {
        const bool areJoined = DirectionOf(FCCStep::Subtract(StepOf(b), StepOf(a))) < Directions;
        adjacent[a] |= areJoined ? 1u << b : 0;
      }
    }
    return adjacent;
  }
};

inline constexpr std::array<FCCCells::Simplex, FCCCells::Types> FCCCells::Simplices = FCCCells::MakeSimplices();
inline constexpr std::array<unsigned int, FCCCells::Directions> FCCCells::Adjacent = FCCCells::MakeAdjacent();

constexpr unsigned int
FCCCells::PartOf(unsigned int set, unsigned int direction)
{
  unsigned int part = 1u << direction;
  for (unsigned int added = part; added != 0;)
  {
    unsigned int next = 0;
    for (; added != 0; added &= added - 1)
    {
      next |= Adjacent[static_cast<unsigned int>(__builtin_ctz(added))];
    }
    added = next & set & ~part;
    part |= added;
  }
  return part;
}

inline bool
FCCCells::IsDisk(unsigned int set)
{
  static const auto areDisks = [] {
    const auto isConnected = [](unsigned int some) {
      return some != 0 && PartOf(some, static_cast<unsigned int>(__builtin_ctz(some))) == some;
    };
    std::bitset<AllDirections + 1> disks;
    for (unsigned int some = 0; some <= AllDirections; ++some)
    {
      disks[some] = isConnected(some) && isConnected(AllDirections & ~some);
    }
    return disks;
  }();
  return areDisks[set];
}

} // namespace itk

#endif
