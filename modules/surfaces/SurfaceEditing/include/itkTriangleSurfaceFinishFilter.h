#ifndef itkTriangleSurfaceFinishFilter_h
#define itkTriangleSurfaceFinishFilter_h

#include "itkTriangleSurfaceToTriangleSurfaceFilter.h"
#include "rhombicSurfaceFinish.h"

#include <string>
#include <vector>

namespace itk
{

/** \class TriangleSurfaceFinishFilter
 * \brief The steps of `rhombic mesh` after the extraction of a surface: removes parts, untangles, smooths, simplifies,
 * and turns shells that face the wrong way.
 *
 * By default the surface is untangled and shells are turned only. See rhombic::RemoveParts() and
 * rhombic::RefineSurface(). A surface of which all parts are removed is empty.
 *
 * \ingroup SurfaceEditing
 */
class TriangleSurfaceFinishFilter : public TriangleSurfaceToTriangleSurfaceFilter
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(TriangleSurfaceFinishFilter);

  using Self = TriangleSurfaceFinishFilter;
  using Superclass = TriangleSurfaceToTriangleSurfaceFilter;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(TriangleSurfaceFinishFilter, TriangleSurfaceToTriangleSurfaceFilter);

  /** Spacing of the lattice in mm, above 0: the largest move of a point by untangling, and the unit of Smoothing.
   * Default 1. */
  itkSetMacro(Spacing, double);
  itkGetConstMacro(Spacing, double);

  /** Volume in ml; smaller solids are removed. Default 0. */
  itkSetMacro(MinimumVolume, double);
  itkGetConstMacro(MinimumVolume, double);

  /** Whether all solids but the largest are removed. Default off. */
  itkSetMacro(KeepLargestPart, bool);
  itkGetConstMacro(KeepLargestPart, bool);
  itkBooleanMacro(KeepLargestPart);

  /** Whether shells inside others are removed. Default off. */
  itkSetMacro(FillCavities, bool);
  itkGetConstMacro(FillCavities, bool);
  itkBooleanMacro(FillCavities);

  /** Largest move of a point by smoothing, in spacings, 0 to 1. Default 0: no smoothing. */
  itkSetMacro(Smoothing, double);
  itkGetConstMacro(Smoothing, double);

  /** Largest error of simplification in mm. Default 0: no simplification, or with a limit of triangles one spacing. */
  itkSetMacro(MaximumError, double);
  itkGetConstMacro(MaximumError, double);

  /** Number of triangles at which simplification ends. Default 0: no limit. */
  itkSetMacro(MaximumTriangles, SizeValueType);
  itkGetConstMacro(MaximumTriangles, SizeValueType);

  /** Shells that the last update removed. */
  itkGetConstReferenceMacro(Removal, rhombic::PartRemoval);

  /** Results of the last update's other steps. */
  itkGetConstReferenceMacro(Refinement, rhombic::Refinement);

  /** Lines about the last update: removed shells, moves of points, failures. */
  itkGetConstReferenceMacro(Notes, std::vector<std::string>);

protected:
  TriangleSurfaceFinishFilter() = default;
  ~TriangleSurfaceFinishFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() ITKv5_CONST override;

  void
  Edit(TriangleSurface & surface, const rhombic::ProgressFunction & report) override;

private:
  rhombic::SurfaceFinish
  MakeFinish() const;

  double m_Spacing{ 1.0 };
  double m_MinimumVolume{ 0.0 };
  bool m_KeepLargestPart{ false };
  bool m_FillCavities{ false };
  double m_Smoothing{ 0.0 };
  double m_MaximumError{ 0.0 };
  SizeValueType m_MaximumTriangles{ 0 };
  rhombic::PartRemoval m_Removal;
  rhombic::Refinement m_Refinement;
  std::vector<std::string> m_Notes;
};

} // namespace itk

#endif
