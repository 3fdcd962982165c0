#ifndef itkSheetSmoothing_h
#define itkSheetSmoothing_h

#include "detail/itkBoundedMoves.h"

namespace itk
{

/** \class SheetNeighbours
 * \brief The points towards whose mean each point of a surface of sheets is smoothed: those around it in a sheet, the
 * two beside it on a curve, none if it is fixed. */
class SheetNeighbours
{
public:
  SheetNeighbours(const TrianglesOfPoints & fans, const PointStrata & strata);

  std::size_t
  GetNumberOfPoints() const
  {
    return m_Begin.size() - 1;
  }

  /** Calls \a visit(neighbour) for each neighbour of a point, and returns how many there are. */
  template <typename TVisitor>
  std::size_t
  Visit(SizeValueType point, const TVisitor & visit) const
  {
    for (std::size_t n = m_Begin[point]; n < m_Begin[point + 1]; ++n)
    {
      visit(m_Ids[n]);
    }
    return m_Begin[point + 1] - m_Begin[point];
  }

private:
  BulkVector<std::size_t> m_Begin; ///< index of each point's first neighbour, and the end of the last
  BulkVector<std::uint32_t> m_Ids;
};

/** Smooths a surface of sheets towards the result of a low-pass filter, as far as \a moves allow, as one stage of the
 * progress; after Taubin, Zhang and Golub, "Optimal surface smoothing as filter design" (ECCV 1996).
 *
 * The filter is a polynomial of the umbrella operator (a point minus the mean of its neighbours), whose degree is \a
 * iterations: an ideal low-pass filter, cut off by a Hamming window. Waves of the surface pass that are longer than
 * about iterations / 2 edges; pits and steps do not. Curves where sheets meet are filtered along themselves, and fixed
 * points stay.
 *
 * A low-pass filter pulls surfaces to the inner side of their bends, thin tubes to their axis. So what a neighbourhood
 * has moved along its normals on average is taken back: the move along the normals, filtered in the same way. A tube
 * keeps its radius then, and becomes round. On curves nothing is taken back: the sheets that meet there have no common
 * normal, and where something was, triangles at curves folded. */
void
SmoothSheets(const TriangleSurface & surface,
             const TrianglesOfPoints & fans,
             const PointStrata & strata,
             unsigned int iterations,
             BoundedMoves & moves,
             rhombic::StagedProgress & progress,
             double stageEnd);

} // namespace itk

#endif
