#ifndef itkImageToFCCLabelsFilter_h
#define itkImageToFCCLabelsFilter_h

#include "itkFCCImage.h"
#include "itkFCCLabelWeights.h"
#include "itkImageToImageFilter.h"

namespace itk
{

/** \class ImageToFCCLabelsFilter
 * \brief Base of filters that bring labels onto the FCC lattice for FCCLabelSurfaceFilter.
 *
 * The first output has the label of each site, the second the weights of labels near walls. Both are made as a whole,
 * from whole inputs.
 *
 * Throws when the density is not above 0 and at most 64, and when a row of the lattice would have more than 65,535
 * sites.
 *
 * \ingroup LabelSurfaces
 */
template <typename TInputImage>
class ITK_TEMPLATE_EXPORT ImageToFCCLabelsFilter
  : public ImageToImageFilter<TInputImage, FCCImage<FCCLabelWeights::LabelType>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ImageToFCCLabelsFilter);

  using Self = ImageToFCCLabelsFilter;
  using LabelType = FCCLabelWeights::LabelType;
  using InputImageType = TInputImage;
  using LatticeType = FCCImage<LabelType>;
  using Superclass = ImageToImageFilter<InputImageType, LatticeType>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkTypeMacro(ImageToFCCLabelsFilter, ImageToImageFilter);

  /** Sites for each voxel, or part of a voxel where thick slices are divided. Default FCCLattice::DefaultDensity. */
  itkSetMacro(Density, double);
  itkGetConstMacro(Density, double);

  /** The weights of labels near walls, sorted. */
  FCCLabelWeights *
  GetWeights()
  {
    return itkDynamicCastInDebugMode<FCCLabelWeights *>(this->ProcessObject::GetOutput(1));
  }

protected:
  ImageToFCCLabelsFilter()
  {
    this->SetNumberOfRequiredOutputs(2);
    this->ProcessObject::SetNthOutput(1, FCCLabelWeights::New().GetPointer());
  }
  ~ImageToFCCLabelsFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override
  {
    Superclass::PrintSelf(os, indent);
    os << indent << "Density: " << m_Density << std::endl;
  }

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(ProcessObject::DataObjectPointerArraySizeType index) override
  {
    return index == 0 ? Superclass::MakeOutput(index) : DataObject::Pointer(FCCLabelWeights::New());
  }

  void
  VerifyPreconditions() ITKv5_CONST override
  {
    Superclass::VerifyPreconditions();
    if (!(m_Density > 0.0) || !(m_Density <= 64.0))
    {
      itkExceptionMacro("The Density must be above 0 and at most 64 sites per voxel, not " << m_Density << ".");
    }
  }

  void
  EnlargeOutputRequestedRegion(DataObject * output) override
  {
    output->SetRequestedRegionToLargestPossibleRegion();
  }

  void
  GenerateInputRequestedRegion() override
  {
    for (const auto & input : this->GetInputs())
    {
      input->SetRequestedRegionToLargestPossibleRegion();
    }
  }

private:
  double m_Density = FCCLattice::DefaultDensity;
};

} // namespace itk

#endif
