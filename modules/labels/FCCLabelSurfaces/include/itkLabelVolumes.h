#ifndef itkLabelVolumes_h
#define itkLabelVolumes_h

#include "itkLabelWalls.h"

#include <functional>
#include <vector>

namespace itk
{

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
  /** \param volumes to reach in mm^3, by label: of all labels that have walls */
  explicit LabelVolumes(const std::vector<double> & volumes);

  using BoundType = std::function<double(std::size_t label, double layer)>;

  /** The layers by which labels reach their volumes, as far as they may, by label: the solution of a linear system, by
   * Gauss-Seidel sweeps until layers change by less than 1e-5 of the largest. Holds until the next call.
   * \param walls as the last layers have moved them
   * \param bound returns the layer of a label, or the nearest that it may have; may be empty */
  const std::vector<double> &
  FindLayers(const LabelWalls & walls, const BoundType & bound = {});

private:
  std::vector<double> m_WantedRoots; ///< cube roots of volumes, which are nearly linear in layers
  std::vector<double> m_Roots;       ///< the same of the walls at the last call
  std::vector<double> m_Layers;
};

} // namespace itk

#endif
