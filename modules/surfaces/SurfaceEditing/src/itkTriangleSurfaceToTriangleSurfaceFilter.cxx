#include "itkTriangleSurfaceToTriangleSurfaceFilter.h"

#include "itkWorkProgress.h"

namespace itk
{

TriangleSurfaceToTriangleSurfaceFilter::TriangleSurfaceToTriangleSurfaceFilter()
{
  this->SetNumberOfRequiredInputs(1);
  this->SetNumberOfRequiredOutputs(1);
  this->ProcessObject::SetNthOutput(0, this->MakeOutput(0));
}

void
TriangleSurfaceToTriangleSurfaceFilter::SetInput(const TriangleSurface * surface)
{
  this->ProcessObject::SetNthInput(0, const_cast<TriangleSurface *>(surface));
}

const TriangleSurface *
TriangleSurfaceToTriangleSurfaceFilter::GetInput() const
{
  return itkDynamicCastInDebugMode<const TriangleSurface *>(this->GetPrimaryInput());
}

TriangleSurface *
TriangleSurfaceToTriangleSurfaceFilter::GetOutput()
{
  return itkDynamicCastInDebugMode<TriangleSurface *>(this->GetPrimaryOutput());
}

const TriangleSurface *
TriangleSurfaceToTriangleSurfaceFilter::GetOutput() const
{
  return itkDynamicCastInDebugMode<const TriangleSurface *>(this->GetPrimaryOutput());
}

DataObject::Pointer
TriangleSurfaceToTriangleSurfaceFilter::MakeOutput(DataObjectPointerArraySizeType)
{
  return TriangleSurface::New().GetPointer();
}

void
TriangleSurfaceToTriangleSurfaceFilter::GenerateData()
{
  if (this->GetInput()->GetDataReleased())
  {
    itkExceptionMacro("The input's data were released: turn its ReleaseDataFlag off, or fill it anew before each "
                      "update.");
  }
  this->GetInput()->VerifyTriangles();
  constexpr SizeValueType wholeWork = SizeValueType{ 1 } << 30;
  WorkProgress progress(*this, wholeWork);
  const auto report = [&progress](double share) {
    const auto done = static_cast<SizeValueType>(share * static_cast<double>(wholeWork));
    progress.Completed(std::max(done, progress.GetCompleted()) - progress.GetCompleted());
  };
  TriangleSurface & output = *this->GetOutput();
  output.Graft(this->GetInput());
  try
  {
    this->Edit(output, report);
  }
  catch (...)
  {
    output.Initialize();
    throw;
  }
  progress.Finish();
}

} // namespace itk
