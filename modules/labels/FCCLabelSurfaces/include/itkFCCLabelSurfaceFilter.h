#ifndef itkFCCLabelSurfaceFilter_h
#define itkFCCLabelSurfaceFilter_h

#include "itkFCCImage.h"
#include "itkFCCLabelWeights.h"
#include "itkLabelWalls.h"
#include "itkProcessObject.h"

namespace itk
{

/** \class FCCLabelSurfaceFilter
 * \brief The walls between the labels of an FCC image, as one mesh: no gaps, no overlaps.
 *
 * Each site has a label, 0 being outside; the image is taken to be surrounded by outside. The lattice's cells are cut
 * into tetrahedra, as by the mode Tetrahedra of FCCIsosurfaceFilter. Edges between two labels, faces of three and
 * tetrahedra of four each get a point, and the walls in a tetrahedron are 1, 2, 5 or 12 triangles between them. Every
 * triangle parts exactly two labels, and there is no case without an answer: for any labels, noise included,
 * - the surface of each label is closed, oriented and manifold,
 * - triangles meet in common edges and points only,
 * - edges with more than two triangles are where three labels or more meet.
 *
 * With weights (SetWeights()), a point lies where the weights of its labels tie, interpolated linearly: on edges that
 * is always between the ends if the label of each site has the largest weight there. Ties outside of their face or
 * tetrahedron, or near its border, are moved towards its middle. Without weights, points are in the middle.
 *
 * The passes are the same as for isosurfaces: cut edges as bits; counts of each plane; sums, which give each plane its
 * part of the output; points and triangles of all planes. Faces and tetrahedra follow from the bits of their edges. The
 * output has the same bytes for any number of threads. Time grows with the number of sites and with the area of the
 * walls, not with the number of labels. Memory: the mesh, and 13 bytes a site of three planes for each thread.
 *
 * The output has no normals. Throws when samples are missing from the input's buffer, when the weights do not have one
 * row for each of the image's, and when the mesh has 2^32 points or more.
 *
 * \ingroup FCCLabelSurfaces
 */
class FCCLabelSurfaceFilter : public ProcessObject
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(FCCLabelSurfaceFilter);

  using Self = FCCLabelSurfaceFilter;
  using Superclass = ProcessObject;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(FCCLabelSurfaceFilter, ProcessObject);

  using LabelType = LabelWalls::LabelType;
  using InputImageType = FCCImage<LabelType>;

  /** The least barycentric coordinate of a point in its edge. */
  static constexpr double MinimumFraction = 1.0 / 128.0;

  using Superclass::SetInput;
  void
  SetInput(const InputImageType * labels)
  {
    this->ProcessObject::SetNthInput(0, const_cast<InputImageType *>(labels));
  }
  const InputImageType *
  GetInput() const
  {
    return itkDynamicCastInDebugMode<const InputImageType *>(this->GetPrimaryInput());
  }

  /** Weights of the labels near walls, sorted. Default none. */
  itkSetInputMacro(Weights, FCCLabelWeights);
  itkGetInputMacro(Weights, FCCLabelWeights);

  /** The least barycentric coordinate of a point in its face or tetrahedron, from MinimumFraction to 0.25. Where labels
   * meet triangles are small, and points near the border of their face make slivers, whose normals are arbitrary; but
   * points that are kept off it do not follow the weights. Default 0.1. */
  itkSetClampMacro(JunctionFraction, double, MinimumFraction, 0.25);
  itkGetConstMacro(JunctionFraction, double);

  LabelWalls *
  GetOutput()
  {
    return itkDynamicCastInDebugMode<LabelWalls *>(this->GetPrimaryOutput());
  }
  const LabelWalls *
  GetOutput() const
  {
    return itkDynamicCastInDebugMode<const LabelWalls *>(this->GetPrimaryOutput());
  }

protected:
  FCCLabelSurfaceFilter()
  {
    this->SetNumberOfRequiredInputs(1);
    this->SetNumberOfRequiredOutputs(1);
    this->ProcessObject::SetNthOutput(0, this->MakeOutput(0));
  }
  ~FCCLabelSurfaceFilter() override = default;

  using Superclass::MakeOutput;
  DataObject::Pointer
  MakeOutput(DataObjectPointerArraySizeType) override
  {
    return LabelWalls::New().GetPointer();
  }

  void
  GenerateInputRequestedRegion() override
  {
    const_cast<InputImageType *>(this->GetInput())->SetRequestedRegionToLargestPossibleRegion();
  }

  void
  GenerateData() override;

private:
  double m_JunctionFraction = 0.1;
};

} // namespace itk

#endif
