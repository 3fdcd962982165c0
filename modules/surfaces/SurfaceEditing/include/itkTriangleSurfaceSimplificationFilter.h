#ifndef itkTriangleSurfaceSimplificationFilter_h
#define itkTriangleSurfaceSimplificationFilter_h

#include "itkTriangleSurfaceSimplification.h"
#include "itkTriangleSurfaceToTriangleSurfaceFilter.h"

namespace itk
{

/** \class TriangleSurfaceSimplificationFilter
 * \brief Reduces the number of triangles of a surface and keeps its topology, as SimplifyTriangleSurface() does.
 *
 * Simplification ends at TargetTriangles or at MaximumError, whichever comes first; at least one must be set.
 *
 * \ingroup SurfaceEditing
 */
class TriangleSurfaceSimplificationFilter : public TriangleSurfaceToTriangleSurfaceFilter
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(TriangleSurfaceSimplificationFilter);

  using Self = TriangleSurfaceSimplificationFilter;
  using Superclass = TriangleSurfaceToTriangleSurfaceFilter;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(TriangleSurfaceSimplificationFilter, TriangleSurfaceToTriangleSurfaceFilter);

  /** Number of triangles at which simplification ends. Default 0: as few as MaximumError allows. */
  itkSetMacro(TargetTriangles, SizeValueType);
  itkGetConstMacro(TargetTriangles, SizeValueType);

  /** Largest distance between the surfaces, in mm, above 0. Default infinity. */
  itkSetMacro(MaximumError, double);
  itkGetConstMacro(MaximumError, double);

  /** Numbers of the last update. */
  itkGetConstReferenceMacro(Report, TriangleSurfaceSimplificationReport);

protected:
  TriangleSurfaceSimplificationFilter() = default;
  ~TriangleSurfaceSimplificationFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() ITKv5_CONST override;

  void
  Edit(TriangleSurface & surface, const rhombic::ProgressFunction & report) override;

private:
  SizeValueType m_TargetTriangles{ TriangleSurfaceSimplificationSettings().targetTriangles };
  double m_MaximumError{ TriangleSurfaceSimplificationSettings().maximumError };
  TriangleSurfaceSimplificationReport m_Report;
};

} // namespace itk

#endif
