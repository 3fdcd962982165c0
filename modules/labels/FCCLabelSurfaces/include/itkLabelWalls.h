#ifndef itkLabelWalls_h
#define itkLabelWalls_h

#include "itkTriangleSurface.h"

namespace itk
{

/** \class LabelWalls
 * \brief The walls between labelled regions, as one mesh in which each triangle knows the two labels that it parts.
 *
 * Label 0 is outside. The labels of a triangle are in ascending order, and the triangle is counter-clockwise seen from
 * the region of the first. So the triangles whose second label is L belong to the surface of L as they are, and the
 * triangles whose first label is L belong to that surface turned over. Four bytes a triangle more than a
 * TriangleSurface.
 *
 * \ingroup FCCLabelSurfaces
 */
class LabelWalls : public TriangleSurface
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LabelWalls);

  using Self = LabelWalls;
  using Superclass = TriangleSurface;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(LabelWalls, TriangleSurface);

  using LabelType = std::uint16_t;
  using LabelPairType = std::array<LabelType, 2>;
  using LabelPairsContainer = BulkVector<LabelPairType>;

  /** The labels of each triangle. */
  LabelPairsContainer &
  GetTriangleLabels()
  {
    return m_TriangleLabels.Change();
  }
  const LabelPairsContainer &
  GetTriangleLabels() const
  {
    return m_TriangleLabels.Get();
  }

  /** The volume in mm^3 that the walls of each label enclose, up to the largest label; for 0 that of all others,
   * negative. */
  std::vector<double>
  ComputeVolumes() const;

  /** The labels that have walls, ascending, without 0. */
  std::vector<LabelType>
  FindLabels() const;

  /** The closed surface of a label: its walls, counter-clockwise seen from outside of it, in the order of the mesh, and
   * their points. For label 0 it is the border of all others, facing inwards. Empty if the label has no walls. */
  TriangleSurface::Pointer
  ExtractLabel(LabelType label) const;

  /** Replaces each label by labels[label], and removes the walls between labels that become equal. */
  void
  MergeLabels(const std::vector<LabelType> & labels);

  void
  Initialize() override;

  /** Shares the arrays of other LabelWalls. */
  void
  Graft(const DataObject * data) override;

protected:
  LabelWalls() = default;
  ~LabelWalls() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

private:
  SharedArray<LabelPairsContainer> m_TriangleLabels;
};

} // namespace itk

#endif
