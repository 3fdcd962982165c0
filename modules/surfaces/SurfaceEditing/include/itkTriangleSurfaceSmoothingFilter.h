#ifndef itkTriangleSurfaceSmoothingFilter_h
#define itkTriangleSurfaceSmoothingFilter_h

#include "itkTriangleSurfaceSmoothing.h"
#include "itkTriangleSurfaceToTriangleSurfaceFilter.h"

namespace itk
{

/** \class TriangleSurfaceSmoothingFilter
 * \brief Smooths a surface without shrinking it, as SmoothTriangleSurface() does.
 *
 * \ingroup SurfaceEditing
 */
class TriangleSurfaceSmoothingFilter : public TriangleSurfaceToTriangleSurfaceFilter
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(TriangleSurfaceSmoothingFilter);

  using Self = TriangleSurfaceSmoothingFilter;
  using Superclass = TriangleSurfaceToTriangleSurfaceFilter;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(TriangleSurfaceSmoothingFilter, TriangleSurfaceToTriangleSurfaceFilter);

  /** Number of pairs of one step inwards and one step outwards. Default 20. */
  itkSetMacro(Iterations, unsigned int);
  itkGetConstMacro(Iterations, unsigned int);

  /** Largest distance of a point from its start, in mm, finite and not negative. Default 0: points stay. */
  itkSetMacro(MaximumMove, double);
  itkGetConstMacro(MaximumMove, double);

  /** Numbers of the last update. */
  itkGetConstReferenceMacro(Report, TriangleSurfaceSmoothingReport);

protected:
  TriangleSurfaceSmoothingFilter() = default;
  ~TriangleSurfaceSmoothingFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  VerifyPreconditions() ITKv5_CONST override;

  void
  Edit(TriangleSurface & surface, const rhombic::ProgressFunction & report) override;

private:
  unsigned int m_Iterations{ TriangleSurfaceSmoothingSettings().iterations };
  double m_MaximumMove{ TriangleSurfaceSmoothingSettings().maximumMove };
  TriangleSurfaceSmoothingReport m_Report;
};

} // namespace itk

#endif
