#ifndef rhombicPageMesh_h
#define rhombicPageMesh_h

#include "rhombicColourScale.h"
#include "rhombicForEachBlock.h"
#include "rhombicSceneSurface.h"
#include "rhombicVector3.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rhombic
{

/** Triangles that one surface has, or two that touch. */
struct PageSheet
{
  std::uint32_t front = 0;   ///< number of the surface that has the triangles as they are, from 1
  std::uint32_t back = 0;    ///< of the surface that has them turned over; 0: none
  std::size_t triangles = 0; ///< number of them
};

/** \class PageMesh
 * \brief The surfaces of a page as one mesh, coded by meshoptimizer. Walls that two surfaces share are held once.
 *
 * Positions are 16-bit numbers: origin + quantum * number. */
struct PageMesh
{
  Vector3 origin{};
  Vector3 extent{};     ///< mm along x, y and z
  double quantum = 0.0; ///< mm
  std::size_t points = 0;
  std::size_t triangles = 0;
  std::size_t trianglesBefore = 0; ///< of the surfaces that were given, with shared walls once
  double error = 0.0;              ///< mm that no part of the surfaces was moved farther than; 0: not simplified
  double measuredError = 0.0;      ///< mm, the largest distance where it was measured
  std::string refusal;             ///< why they were not simplified, as a sentence; empty if they were
  std::vector<PageSheet> sheets;   ///< in the order of their triangles
  std::string pointBytes;    ///< zlib streams of meshoptimizer's codes: 4 numbers for each point, the last that of
                             ///< its value, from 1 to 255, 0 without one,
  std::string triangleBytes; ///< and 3 indices for each triangle
};

/** \class PageMeshMaker
 * \brief Simplifies surfaces, walls that they share only once, and codes them. */
class PageMeshMaker
{
public:
  /** \param scale of the values of points; with one, walls that surfaces share are held for each of them */
  explicit PageMeshMaker(const std::vector<SceneSurface> & surfaces, const std::optional<ColourScale> & scale = {});

  std::size_t
  GetNumberOfTriangles() const;

  /** Simplifies to so many triangles, if that moves no part of the surfaces farther than \a error mm from where they
   * were at first. Surfaces that can't be simplified, as with edges that are not manifold, stay as they are. */
  void
  Simplify(std::size_t triangles, double error, const ProgressFunction & report = {});

  PageMesh
  Make() const;

private:
  /** Whether no triangle belongs to two surfaces. */
  bool
  AreApart() const
  {
    return std::all_of(m_Sides.begin(), m_Sides.end(), [](const auto & sides) { return sides[1] == 0; });
  }

  /** The numbers of the values of points of the simplified surface: those of the nearest points before. */
  std::vector<std::uint16_t>
  NumberValues() const;

  itk::TriangleSurface::ConstPointer m_Original;
  itk::TriangleSurface::Pointer m_Surface;
  std::vector<std::array<std::uint32_t, 2>> m_Sides; ///< surfaces of the sheets
  std::vector<std::uint32_t> m_Sheets;               ///< of the triangles
  double m_Error = 0.0;
  std::string m_Refusal;
  std::optional<ColourScale> m_Scale;
  std::vector<SceneSurface> m_Valued; ///< the surfaces, if there is a scale
};

} // namespace rhombic

#endif
