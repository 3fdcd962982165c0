#ifndef itkTriangleSurfaceAgreementFilter_h
#define itkTriangleSurfaceAgreementFilter_h

#include "itkTriangleSurfaceAgreement.h"

#include "itkProcessObject.h"

namespace itk
{

/** \class TriangleSurfaceAgreementFilter
 * \brief Compares two closed surfaces, as HausdorffDistanceImageFilter does images: ComputeTriangleSurfaceAgreement().
 *
 * The output is the first surface, unchanged, so that the filter may stand in a pipeline. The work runs on as many
 * threads as MultiThreaderBase's global default number; NumberOfWorkUnits has no effect.
 *
 * \ingroup SurfaceAgreement
 */
class TriangleSurfaceAgreementFilter : public ProcessObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(TriangleSurfaceAgreementFilter);

  using Self = TriangleSurfaceAgreementFilter;
  using Superclass = ProcessObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(TriangleSurfaceAgreementFilter, ProcessObject);

  /** The first surface, A in tables; it is passed on. */
  void
  SetInput1(const TriangleSurface * surface)
  {
    this->SetNthInput(0, const_cast<TriangleSurface *>(surface));
  }
  /** The surface that the first one is compared with. */
  void
  SetInput2(const TriangleSurface * surface)
  {
    this->SetNthInput(1, const_cast<TriangleSurface *>(surface));
  }
  /** The surface of SetInput1(). */
  const TriangleSurface *
  GetInput1() const
  {
    return itkDynamicCastInDebugMode<const TriangleSurface *>(this->ProcessObject::GetInput(0));
  }
  /** The surface of SetInput2(). */
  const TriangleSurface *
  GetInput2() const
  {
    return itkDynamicCastInDebugMode<const TriangleSurface *>(this->ProcessObject::GetInput(1));
  }

  TriangleSurface *
  GetOutput()
  {
    return itkDynamicCastInDebugMode<TriangleSurface *>(this->GetPrimaryOutput());
  }

  /** Tolerance of the normalised Dice in mm. Default 1. */
  itkSetMacro(Tolerance, double);
  itkGetConstMacro(Tolerance, double);

  /** Result of the last update. */
  itkGetConstReferenceMacro(Agreement, TriangleSurfaceAgreement);

protected:
  TriangleSurfaceAgreementFilter();
  ~TriangleSurfaceAgreementFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(DataObjectPointerArraySizeType) override
  {
    return TriangleSurface::New().GetPointer();
  }

  void
  GenerateData() override;

private:
  double m_Tolerance{ 1.0 };
  TriangleSurfaceAgreement m_Agreement;
};

} // namespace itk

#endif
