#ifndef itkEdgeCollapse_h
#define itkEdgeCollapse_h

#include "itkLocalIds.h"
#include "itkQuadric.h"
#include "itkTriangleTree.h"

#include <queue>
#include <tuple>

namespace itk
{

/** \class EdgeCollapse
 * \brief Shrinks edges of some triangles of a surface, one after the other.
 *
 * The edges of least error come first, the error being that of Garland and Heckbert, "Surface simplification using
 * quadric error metrics" (SIGGRAPH 1997): the root of the mean squared distance from the planes of the triangles that
 * the edge's points have stood for. An edge shrinks to the place where that is least, and only where the link condition
 * of Dey et al., "Topology preserving edge contraction" (1999) holds, so the topology stays as it is; where no triangle
 * turns by much, loses its area or becomes a sliver; and where the surface stays near the original.
 *
 * The border of the triangles stays, and no new edge joins two of its points: whatever parts of a surface are
 * simplified, they fit together.
 *
 * \ingroup SurfaceEditing
 */
class EdgeCollapse
{
public:
  using PointId = std::uint32_t;
  using TriangleId = std::uint32_t;
  using PointType = TriangleSurface::PointType;
  using TriangleType = TriangleSurface::TriangleType;

  /** A point of the original surface, and the number of the triangle that stands for what was there. */
  struct Witness
  {
    PointId point;
    TriangleId triangle;
  };

  /** Some triangles of a surface, and the witnesses of all of them. */
  struct Part
  {
    std::vector<TriangleType> triangles;
    std::vector<Witness> witnesses;
  };

  /** What the surface must stay near to: places of the triangles to the original, its witnesses to the triangles. */
  struct Original
  {
    const TriangleTree * tree;                  ///< null if there is no limit to distances; then there are no witnesses
    double limit;                               ///< mm
    const std::vector<TriangleId> * nearPoints; ///< for each point of the surface, a triangle of the original nearby
  };

  /** A point that has moved. */
  struct MovedPoint
  {
    PointId id;
    PointType position;
    TriangleSurface::NormalType normal; // without length if the surface has no normals
    TriangleId near;                    // of the original
  };

  /** How far it goes: as far as neither is passed. */
  struct Goal
  {
    double error;              ///< mm, see above
    std::size_t triangles = 0; ///< that are left
  };

  /** How many triangles are left after all edges of up to an error have shrunk. */
  struct Progress
  {
    double error;
    std::size_t triangles;
  };

  /** \param surface its points and normals
   * \param isHeld for each triangle, whether its points must stay; may be empty */
  EdgeCollapse(const TriangleSurface & surface,
               const Part & part,
               const std::vector<std::uint8_t> & isHeld,
               const Original & original);

  /** Shrinks edges. Returns its progress, by growing error. */
  std::vector<Progress>
  Run(const Goal & goal);

  /** What is left: first the triangles that are as they were, then the new ones. */
  Part
  GetResult() const;

  /** How many of the triangles that are left are as they were. */
  std::size_t
  CountOldTriangles() const;

  /** Whether edges did not shrink because of the error or the distance from the original. */
  bool
  WasHeldBack() const
  {
    return m_WasHeldBack;
  }

  /** The points that are elsewhere than they were at first. */
  std::vector<MovedPoint>
  GetMovedPoints() const;

private:
  using CornerId = std::uint32_t; // 3 * triangle + 0, 1 or 2
  using WitnessId = std::uint32_t;

  /** A triangle around a place. */
  struct Fan
  {
    TriangleId triangle;
    PointId next;
    PointId last;
  };

  /** An edge that is to shrink; point \a from is to vanish. */
  struct Candidate
  {
    float error;
    PointId from;
    PointId to;
    std::uint32_t version; // the sum of its points' versions that it is from

    friend bool
    operator<(const Candidate & a, const Candidate & b) // the least comes first in a queue
    {
      return std::tie(a.error, a.from, a.to) > std::tie(b.error, b.from, b.to);
    }
  };

  template <typename TVisit>
  void
  ForEachTriangle(PointId point, const TVisit & visit) const
  {
    for (CornerId corner = m_FirstCorner[point]; corner != None; corner = m_NextCorner[corner])
    {
      if (m_IsLeft[corner / 3])
      {
        visit(corner / 3, m_Triangles[corner / 3][(corner + 1) % 3], m_Triangles[corner / 3][(corner + 2) % 3]);
      }
    }
  }

  void
  AddWitnesses(const std::vector<Witness> & witnesses);
  void
  FindBorder();
  void
  AddQuadrics();
  void
  Propose(PointId a, PointId b);
  void
  ProposeAround(PointId point);
  PositionType
  PlaceFor(PointId from, PointId to) const;
  bool
  IsTopologyKept(PointId from, PointId to);
  bool
  IsShapeKept(PointId from, PointId to, const PositionType & place) const;
  bool
  IsShapeKeptAround(PointId moved, PointId other, const PositionType & place) const;
  bool
  StaysNear(PointId from, PointId to, const PositionType & place);
  bool
  IsNearOriginal(PointId from, PointId to, const PositionType & place);
  bool
  AreWitnessesNear(PointId from, PointId to, const PositionType & place);
  void
  Collapse(PointId from, PointId to, const PositionType & place);
  void
  MoveWitnesses();
  void
  MixNormals(PointId from, PointId to, const PositionType & place);

  static constexpr std::uint32_t None = std::numeric_limits<std::uint32_t>::max();

  const TriangleSurface & m_Surface;
  const Original m_Original;
  const LocalIds m_Ids;
  const PositionType m_Origin; // of positions, to keep digits
  std::vector<TriangleType> m_Triangles;
  std::vector<std::uint8_t> m_IsLeft; // of triangles, as is the next
  std::vector<std::uint8_t> m_IsNew;
  std::size_t m_NumberLeft;
  std::vector<CornerId> m_FirstCorner; // of each point; its other corners follow by m_NextCorner
  std::vector<CornerId> m_NextCorner;
  std::vector<PositionType> m_Positions; // of points, as are the next
  std::vector<PositionType> m_Normals;   // empty if the surface has none
  std::vector<Quadric> m_Quadrics;
  std::vector<std::uint32_t> m_Versions;
  std::vector<std::uint8_t> m_IsOnBorder;
  std::vector<std::uint8_t> m_Stays;
  std::vector<std::uint8_t> m_IsGone;
  std::vector<std::uint8_t> m_HasMoved;
  std::vector<std::uint32_t> m_Marks;
  std::uint32_t m_Mark = 0;
  double m_LargestError = 0.0;
  bool m_WasHeldBack = false;
  std::priority_queue<Candidate> m_Candidates;

  // where there is an original to stay near to
  std::vector<TriangleId> m_Near;       // of each point
  TriangleId m_NearPlace = 0;           // of the place looked at
  std::vector<PointId> m_WitnessPoints; // their ids, and next their positions
  std::vector<PositionType> m_Witnesses;
  std::vector<WitnessId> m_FirstWitness; // of each triangle; others follow by m_NextWitness
  std::vector<WitnessId> m_NextWitness;
  std::vector<Fan> m_Fan;                                   // what the edge looked at will become
  std::vector<std::pair<WitnessId, TriangleId>> m_Assigned; // witnesses of the edge looked at
};

} // namespace itk

#endif
