#ifndef itkLabelsToFCCFilter_h
#define itkLabelsToFCCFilter_h

#include "itkImage.h"
#include "itkImageToFCCLabelsFilter.h"
#include "itkSlicePlacement.h"

#include <vector>

namespace itk
{

/** \class LabelsToFCCFilter
 * \brief Brings a label map onto the FCC lattice, without the steps of its voxels and slices, for
 * FCCLabelSurfaceFilter.
 *
 * Each label, the background 0 included, becomes a smooth field of depth by AntiAliasMaskImageFilter, which keeps local
 * volumes and thin parts. The fields' values at the sites near walls are the weights; the label of a site is the one of
 * largest weight. As a site has one label, there is no gap and no overlap.
 *
 * Then a constant is added to the weights of each label, so that its walls enclose the volume of its voxels. The
 * constants of all labels follow together from the areas of the walls (LabelVolumes), as what one label gains its
 * neighbours lose. Walls move by at most a voxel for it, which only the smallest labels need, and no label changes its
 * topology.
 *
 * Where voxels are more than 1.5 times as long along an axis as along the shortest, the map is refined along it to
 * voxels that are nearly cubes, and the fields between slices follow from the slices around them. The lattice has
 * Density sites for each of these voxels, along an axis refined to four and more half as many: there fields are as
 * smooth as the slices allow. Its direction is the map's; tilted, sheared and unevenly spaced slices are
 * used at their true positions, as by CartesianToFCCImageFilter. It reaches two voxels beyond the map, where all is 0:
 * labels that reach the map's border are closed at the outer faces of its voxels.
 *
 * A thin part, of voxels in no 2 x 2 x 2 block of their label, is a candidate for the sites whose Voronoi cells its
 * middle passes, whatever the weights are there: the middle is the convex hulls of the centres of a label's voxels in
 * cubes of eight neighbours. Voronoi cells are convex and fill space, so sheets as thin as a voxel have no holes and
 * vessels are not torn. Sites that make no difference to the topology of any label go back to the label of largest
 * weight (LabelTopology). Of several candidates for a site the one of largest weight gets it, and the background last;
 * so parts that are nearer to each other than 1.7 voxels can still interrupt each other, and thin gaps between parts of
 * a label can close. Sheets of two labels back to back, each one voxel thick and 30 wide, have 33 holes each at the
 * default density, 19 at density 2 and none at density 4 (means of 24 pairs in random directions). Pieces of a label
 * stay apart if they have labels of their own in one group (SetGroups()).
 *
 * `rhombic-label-walls` measures distances from the truth and angles of facets, beside a field and an isosurface for
 * each label alone and VTK; `rhombic-thick-labels` does so for walls that are smoothed.
 *
 * The outputs have the same bytes for any number of threads. Each field is made in the bounding box of its label and
 * near the label's border only (AntiAliasMaskImageFilter). Labels are made side by side, each on one thread, while
 * their boxes have together no more voxels than the box of all labels. Time grows with the area of the walls and, much
 * less, with the voxels of all boxes. Memory: 6 bytes a site; 20 bytes a voxel of the box of all labels; 8 bytes for
 * each label at sites within three voxels of its surface.
 *
 * Throws as ImageToFCCLabelsFilter does, when the map has no voxels or its buffer is not whole, and when slice origins
 * are not as many as the slices.
 *
 * \ingroup LabelSurfaces
 */
class LabelsToFCCFilter
  : public ImageToFCCLabelsFilter<Image<FCCLabelWeights::LabelType, 3>>
  , public SlicePlacingFilter
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(LabelsToFCCFilter);

  using Self = LabelsToFCCFilter;
  using Superclass = ImageToFCCLabelsFilter<Image<FCCLabelWeights::LabelType, 3>>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  itkNewMacro(Self);
  itkTypeMacro(LabelsToFCCFilter, ImageToFCCLabelsFilter);

  using SliceOriginsType = std::vector<Point<double, 3>>;

  /** As CartesianToFCCImageFilter::SetScan(). */
  template <typename TScan>
  void
  SetScan(const TScan & scan)
  {
    m_Scan = PlacementOf(scan);
    this->Modified();
  }

  /** As CartesianToFCCImageFilter::SetSliceOrigins(). */
  void
  SetSliceOrigins(const SliceOriginsType & origins);
  const SliceOriginsType &
  GetSliceOrigins() const
  {
    return m_SliceOrigins;
  }

  using GroupsType = std::vector<LabelType>;

  /** The group of each label, 0 being none; labels beyond the end are in none. Labels of a group are kept apart, so
   * that LabelWalls::MergeLabels() can merge them: where sites of two would be neighbours, a gap between them is left
   * to other labels or the background. Default: no groups. */
  void
  SetGroups(const GroupsType & groups);
  const GroupsType &
  GetGroups() const
  {
    return m_Groups;
  }

  /** The volumes of each label's voxels in mm^3, by label. */
  const std::vector<double> &
  GetVoxelVolumes() const
  {
    return m_VoxelVolumes;
  }

protected:
  LabelsToFCCFilter() = default;
  ~LabelsToFCCFilter() override = default;

  void
  PrintSelf(std::ostream & os, Indent indent) const override;

  void
  GenerateOutputInformation() override;

  void
  GenerateData() override;

private:
  /** The origins that were set, or else those of the scan. */
  SliceOriginsType
  FindSliceOrigins() const;

  SlicePlacement m_Scan;
  SliceOriginsType m_SliceOrigins;
  GroupsType m_Groups;
  std::vector<double> m_VoxelVolumes;
};

} // namespace itk

#endif
