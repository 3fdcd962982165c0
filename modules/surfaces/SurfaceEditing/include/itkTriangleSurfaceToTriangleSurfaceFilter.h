#ifndef itkTriangleSurfaceToTriangleSurfaceFilter_h
#define itkTriangleSurfaceToTriangleSurfaceFilter_h

#include "itkProcessObject.h"
#include "itkTriangleSurface.h"
#include "rhombicForEachBlock.h"

namespace itk
{

/** \class TriangleSurfaceToTriangleSurfaceFilter
 * \brief Base of filters that change a surface.
 *
 * The output begins as a copy of the input that shares its arrays; Edit() of a derived class changes it. The input
 * stays as it is. Progress is reported and AbortGenerateData is looked for during the work, on the thread that updates
 * the filter; an aborted update throws ProcessAborted and leaves the output empty.
 *
 * The work runs on as many threads as MultiThreaderBase's global default number; NumberOfWorkUnits has no effect.
 *
 * Throws ExceptionObject if a triangle of the input refers to a missing point, or if the input's data were released and
 * nothing makes them anew.
 *
 * \ingroup SurfaceEditing
 */
class TriangleSurfaceToTriangleSurfaceFilter : public ProcessObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(TriangleSurfaceToTriangleSurfaceFilter);

  using Self = TriangleSurfaceToTriangleSurfaceFilter;
  using Superclass = ProcessObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkTypeMacro(TriangleSurfaceToTriangleSurfaceFilter, ProcessObject);

  using Superclass::SetInput;
  void
  SetInput(const TriangleSurface * surface)
  {
    this->ProcessObject::SetNthInput(0, const_cast<TriangleSurface *>(surface));
  }
  const TriangleSurface *
  GetInput() const
  {
    return itkDynamicCastInDebugMode<const TriangleSurface *>(this->GetPrimaryInput());
  }

  TriangleSurface *
  GetOutput()
  {
    return itkDynamicCastInDebugMode<TriangleSurface *>(this->GetPrimaryOutput());
  }
  const TriangleSurface *
  GetOutput() const
  {
    return itkDynamicCastInDebugMode<const TriangleSurface *>(this->GetPrimaryOutput());
  }

protected:
  TriangleSurfaceToTriangleSurfaceFilter()
  {
    this->SetNumberOfRequiredInputs(1);
    this->SetNumberOfRequiredOutputs(1);
    this->ProcessObject::SetNthOutput(0, this->MakeOutput(0));
  }
  ~TriangleSurfaceToTriangleSurfaceFilter() override = default;

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(DataObjectPointerArraySizeType) override
  {
    return TriangleSurface::New().GetPointer();
  }

  void
  GenerateData() override;

  /** Changes the surface. Calls \a report often with the share of the work that is done; \a report throws
   * ProcessAborted after an abort. */
  virtual void
  Edit(TriangleSurface & surface, const rhombic::ProgressFunction & report) = 0;
};

} // namespace itk

#endif
