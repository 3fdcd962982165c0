#ifndef itkFCCSurfaceParts_h
#define itkFCCSurfaceParts_h

#include "itkTriangleSurface.h"

#include <array>
#include <vector>

namespace itk
{

/** \class FCCSurfaceParts
 * \brief Takes isosurfaces in parts, one slab of planes after the other, so that none has to be in memory as a whole.
 *
 * The functions are called one after the other, on the thread that updates the filter. They may throw.
 *
 * \ingroup FCCIsosurface
 */
class FCCSurfaceParts
{
public:
  /** {xmin, xmax, ymin, ymax, zmin, zmax} in LPS mm. */
  using Bounds = std::array<double, 6>;

  virtual ~FCCSurfaceParts() = default;

  /** Called when a surface is counted. Returns whether it is taken in parts; otherwise it becomes the filter's output.
   * \param surface the number of its isovalue
   * \param firstPoints the number of the first point of each plane, and at the end that of all points
   * \param bounds a box around the surface, about a spacing larger; all 0 for a surface without points */
  virtual bool
  Begin(std::size_t surface, const std::vector<SizeValueType> & firstPoints, const Bounds & bounds) = 0;

  /** Takes the points, in their order, and triangles of the next planes. The triangles of a plane use points of that
   * plane and of the next, in modes of octahedra and parallelepipeds also of the one before; their numbers are those of
   * the whole surface.
   * \param part may be changed
   * \param end the plane behind those of the part */
  virtual void
  Take(std::size_t surface, TriangleSurface & part, SizeValueType end) = 0;
};

} // namespace itk

#endif
