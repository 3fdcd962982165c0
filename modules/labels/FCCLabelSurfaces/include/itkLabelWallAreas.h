#ifndef itkLabelWallAreas_h
#define itkLabelWallAreas_h

#include "itkLabelWalls.h"

#include <functional>
#include <utility>
#include <vector>

namespace itk
{

/** \class LabelWallAreas
 * \brief The areas of walls, and how volumes of labels change with them to first order.
 *
 * A label grows by a layer in mm on all of its surface, or shrinks if it is negative. A wall between two labels moves
 * by the difference of their layers, so that one label gains the volume that the other loses. Label 0, outside, has no
 * layer.
 *
 * \ingroup FCCLabelSurfaces
 */
class LabelWallAreas
{
public:
  using LabelType = LabelWalls::LabelType;

  explicit LabelWallAreas(const LabelWalls & walls);

  /** The volumes in mm^3 that labels gain by layers.
   * \param layers by label; labels beyond the end have no layer */
  std::vector<double>
  FindGains(std::vector<double> layers) const;

  using BoundType = std::function<double(std::size_t label, double layer)>;

  /** The layers by which labels gain volumes, as far as they may: the solution of a linear system, by Gauss-Seidel
   * sweeps until layers change by less than 1e-5 of the largest.
   * \param gains by label; labels beyond the end gain nothing
   * \param bound returns the layer of a label, or the nearest that it may have */
  std::vector<double>
  FindLayers(std::vector<double> gains, const BoundType & bound) const;

private:
  std::vector<std::vector<std::pair<LabelType, double>>> m_Walls; ///< of each label: the other, and the area in mm^2
};

} // namespace itk

#endif
