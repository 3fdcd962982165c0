#ifndef rhombicSceneSurface_h
#define rhombicSceneSurface_h

#include "itkTriangleSurface.h"
#include "rhombicPicture.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace rhombic
{

/** A colour (sRGB) of each point of a surface. */
using PointColours = itk::BulkVector<std::array<std::uint8_t, 3>>;

/** A number of each point of a surface. */
struct PointValues
{
  std::string name;              ///< with the unit, for arrays of files: "thickness_mm"
  itk::BulkVector<float> values; ///< NaN: unknown
};

/** \class SceneSurface
 * \brief A surface with its name and looks. Copies share the surface. */
struct SceneSurface
{
  std::string name; ///< in messages and files
  itk::TriangleSurface::ConstPointer surface;
  Colour colour{ 0.8, 0.8, 0.8 };
  double opacity = 1.0;   ///< above 0, at most 1: share of the background that the near wall of a ball hides on average
  bool isGlossy = false;  ///< shines as if it were wet; matte otherwise
  std::int32_t label = 0; ///< of the region in its label map; 0 for surfaces of no label

  /** Of surfaces that overlap: that of an earlier layer is seen where it lies about half a pixel behind, or less, as
   * walls that both have are simplified apart. */
  std::size_t layer = 0;
  double layerGap = 0.0; ///< mm between such walls of layers that follow each other, if more than half a pixel

  /** In place of the colour; or null. Scenes with such surfaces are drawn without their
   * lights, so that colours are seen as they are. */
  std::shared_ptr<const PointColours> pointColours = nullptr;

  /** The numbers behind the colours of points; or null. */
  std::shared_ptr<const PointValues> pointValues = nullptr;
};

/** Several surfaces as one mesh, in which touching surfaces share their wall: equal points are one point, and a
 * triangle of two surfaces that faces opposite ways in them is one triangle. */
struct JoinedSurfaces
{
  itk::TriangleSurface::Pointer surface; ///< as the first surface with the triangle has it; without normals

  /** For each triangle the numbers of the two surfaces that have it, from 1, ascending; 0 for none as the second. */
  itk::BulkVector<std::array<std::uint32_t, 2>> sides;

  /** For each of the surfaces, the joined points that its points are. */
  std::vector<itk::BulkVector<std::uint32_t>> points;
};

/** Triangles keep their order. Triangles that are in the surfaces more than once otherwise, as where surfaces overlap,
 * stay separate. Time O(n); memory about 70 bytes a triangle. */
JoinedSurfaces
JoinSurfaces(const std::vector<SceneSurface> & surfaces);

} // namespace rhombic

#endif
