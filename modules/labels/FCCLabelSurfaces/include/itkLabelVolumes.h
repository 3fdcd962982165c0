#ifndef itkLabelVolumes_h
#define itkLabelVolumes_h

#include "itkLabelWalls.h"

#include <array>
#include <functional>
#include <map>
#include <vector>

namespace itk
{

/** \class LabelSizes
 * \brief The volumes that walls enclose and the areas of walls, kept up to date while points of the walls move.
 *
 * Memory: 16 bytes for each triangle. The same for any number of threads.
 *
 * \ingroup FCCLabelSurfaces
 */
class LabelSizes
{
public:
  /** Measures all walls.
   * \param labels number of labels, with label 0 */
  LabelSizes(const LabelWalls & walls, std::size_t labels);

  /** Measures some triangles anew, whose points have moved. */
  void
  Update(const LabelWalls & walls, const BulkVector<std::uint32_t> & triangles);

  /** By label, in mm^3; that of label 0 is negative. */
  const std::vector<double> &
  GetVolumes() const
  {
    return m_Volumes;
  }

  /** By pair of labels, in mm^2. */
  const std::map<LabelWalls::LabelPairType, double> &
  GetAreas() const
  {
    return m_Areas;
  }

private:
  /** What a triangle adds. */
  struct Share
  {
    double area = 0.0;
    double volume = 0.0;
  };

  /** Measures the triangles idOf(n) for n < count anew. */
  template <typename TIdOf>
  void
  Measure(const LabelWalls & walls, std::size_t count, const TIdOf & idOf);

  const std::array<double, 3> m_Origin; ///< of volumes
  BulkVector<Share> m_Shares;           ///< by triangle
  std::map<LabelWalls::LabelPairType, double> m_Areas;
  std::vector<double> m_Volumes;
};

/** \class LabelVolumes
 * \brief Finds how labels have to grow so that their walls enclose given volumes.
 *
 * A label grows by a *layer* in mm on all of its surface, or shrinks if the layer is negative. A wall between two
 * labels moves by the difference of their layers, so that one label gains the volume that the other loses. Label 0,
 * outside, has no layer.
 *
 * Volumes are corrected in rounds: FindLayers() finds layers from the volumes and areas of the walls, and its caller
 * moves the walls by the layers. What labels gained by the last layers, compared with the areas, corrects the next
 * ones.
 *
 * \ingroup FCCLabelSurfaces
 */
class LabelVolumes
{
public:
  /** \param volumes to reach in mm^3, by label: of all labels that have walls
   * \param tolerance share of a volume: labels that are as near to theirs get no layer */
  explicit LabelVolumes(const std::vector<double> & volumes, double tolerance = 0.0);

  using BoundType = std::function<double(std::size_t label, double layer)>;

  /** The layers by which labels reach their volumes, as far as they may, by label: the solution of a linear system, by
   * Gauss-Seidel sweeps until layers change by less than 1e-5 of the largest. Holds until the next call.
   * \param sizes as the last layers have changed them
   * \param bound returns the layer of a label, or the nearest that it may have; may be empty */
  const std::vector<double> &
  FindLayers(const LabelSizes & sizes, const BoundType & bound = {});

private:
  double m_Tolerance;
  std::vector<double> m_WantedRoots; ///< cube roots of volumes, which are nearly linear in layers
  std::vector<double> m_Roots;       ///< the same of the walls at the last call
  std::vector<double> m_Layers;
};

} // namespace itk

#endif
