#ifndef itkProbabilitiesToFCCFilter_h
#define itkProbabilitiesToFCCFilter_h

#include "itkImage.h"
#include "itkImageToFCCLabelsFilter.h"

namespace itk
{

/** \class ProbabilitiesToFCCFilter
 * \brief Brings volumes of probabilities, one for each label, onto the FCC lattice for FCCLabelSurfaceFilter.
 *
 * The n-th input, counted from 0, holds the probability of label n + 1, from 0 to 1; label 0 has what the others leave
 * to 1. Walls lie where two labels are equally probable: probabilities are the weights, mapped linearly from [0, 1] to
 * [-FCCLabelWeights::Limit, FCCLabelWeights::Limit].
 *
 * The lattice has Density sites for each voxel, and for each part of a voxel where it is more than 1.5 times as long
 * along an axis as the shortest edge and is divided into parts that are nearly cubes. Each input is smoothed by a
 * Gaussian of half a part, as the place of a step that is sharper than the distance of sites would be lost,
 * and resampled by CartesianToFCCImageFilter. Labels of probability 1 that reach the border of the volume
 * are closed at the outer faces of the voxels there, less probable ones up to three parts of a voxel further inside.
 *
 * All inputs need the same grid. It may be sheared; unevenly spaced slices are refused. Volumes of labels are not
 * corrected. `rhombic-label-walls` measures distances from the truth and angles of facets.
 *
 * The outputs have the same bytes for any number of threads. Inputs are resampled one after another. Memory: 18 bytes a
 * site, 12 bytes a voxel, and 8 bytes for each site and label with a probability between 0 and 1.
 *
 * Throws as ImageToFCCLabelsFilter does, and when inputs are missing, have no voxels, different grids or
 * unevenly spaced slices, or are more than 65,535.
 *
 * \ingroup LabelSurfaces
 */
class ProbabilitiesToFCCFilter : public ImageToFCCLabelsFilter<Image<float, 3>>
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ProbabilitiesToFCCFilter);

  using Self = ProbabilitiesToFCCFilter;
  using Superclass = ImageToFCCLabelsFilter<Image<float, 3>>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(ProbabilitiesToFCCFilter, ImageToFCCLabelsFilter);

protected:
  ProbabilitiesToFCCFilter() = default;
  ~ProbabilitiesToFCCFilter() override = default;

  void
  VerifyInputInformation() ITKv5_CONST override;

  void
  GenerateOutputInformation() override;

  void
  GenerateData() override;
};

} // namespace itk

#endif
