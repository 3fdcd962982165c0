#ifndef itkFCCImage_hxx
#define itkFCCImage_hxx

namespace itk
{

template <typename TPixel>
template <typename TCoordRep>
std::array<double, 3>
FCCImage<TPixel>::TransformPhysicalPointToLattice(const Point<TCoordRep, 3> & point) const
{
  std::array<double, 3> coordinates{};
  for (unsigned int row = 0; row < 3; ++row)
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      coordinates[row] += this->m_PhysicalPointToIndex[row][axis] * (point[axis] - this->m_Origin[axis]);
    }
  }
  return coordinates;
}

template <typename TPixel>
template <typename TCoordRep>
Point<TCoordRep, 3>
FCCImage<TPixel>::TransformLatticeToPhysicalPoint(const std::array<double, 3> & coordinates) const
{
  Point<TCoordRep, 3> point;
  for (unsigned int row = 0; row < 3; ++row)
  {
    double sum = this->m_Origin[row];
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      sum += this->m_IndexToPhysicalPoint[row][axis] * coordinates[axis];
    }
    point[row] = static_cast<TCoordRep>(sum);
  }
  return point;
}

template <typename TPixel>
bool
FCCImage<TPixel>::IsInsideExtent(const std::array<double, 3> & coordinates, const RegionType & region)
{
  constexpr double sitesPerIndex[3] = { 2.0, 1.0, 1.0 };
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    const double begin = sitesPerIndex[axis] * static_cast<double>(region.GetIndex(axis)) - 0.5;
    const double end = begin + sitesPerIndex[axis] * static_cast<double>(region.GetSize(axis));
    if (!(coordinates[axis] >= begin && coordinates[axis] < end)) // false for NaN too
    {
      return false;
    }
  }
  return true;
}

template <typename TPixel>
template <typename TCoordRep>
bool
FCCImage<TPixel>::TransformPhysicalPointToIndex(const Point<TCoordRep, 3> & point, IndexType & index) const
{
  index = FCCLattice::IndexOf(FCCLattice::NearestSite(this->TransformPhysicalPointToLattice(point)));
  return this->GetLargestPossibleRegion().IsInside(index);
}

template <typename TPixel>
template <typename TCoordRep>
auto
FCCImage<TPixel>::TransformPhysicalPointToIndex(const Point<TCoordRep, 3> & point) const -> IndexType
{
  IndexType index;
  this->TransformPhysicalPointToIndex(point, index);
  return index;
}

template <typename TPixel>
template <typename TCoordRep, typename TIndexRep>
bool
FCCImage<TPixel>::TransformPhysicalPointToContinuousIndex(const Point<TCoordRep, 3> & point,
                                                          ContinuousIndex<TIndexRep, 3> & index) const
{
  const auto coordinates = this->TransformPhysicalPointToLattice(point);
  index[0] = static_cast<TIndexRep>(coordinates[0] / 2.0);
  index[1] = static_cast<TIndexRep>(coordinates[1]);
  index[2] = static_cast<TIndexRep>(coordinates[2]);
  return IsInsideExtent(coordinates, this->GetLargestPossibleRegion());
}

template <typename TPixel>
template <typename TIndexRep, typename TCoordRep>
ContinuousIndex<TIndexRep, 3>
FCCImage<TPixel>::TransformPhysicalPointToContinuousIndex(const Point<TCoordRep, 3> & point) const
{
  ContinuousIndex<TIndexRep, 3> index;
  this->TransformPhysicalPointToContinuousIndex(point, index);
  return index;
}

template <typename TPixel>
template <typename TCoordRep, typename TIndexRep>
void
FCCImage<TPixel>::TransformContinuousIndexToPhysicalPoint(const ContinuousIndex<TIndexRep, 3> & index,
                                                          Point<TCoordRep, 3> & point) const
{
  point = this->template TransformLatticeToPhysicalPoint<TCoordRep>(
    { 2.0 * static_cast<double>(index[0]), static_cast<double>(index[1]), static_cast<double>(index[2]) });
}

template <typename TPixel>
template <typename TCoordRep, typename TIndexRep>
Point<TCoordRep, 3>
FCCImage<TPixel>::TransformContinuousIndexToPhysicalPoint(const ContinuousIndex<TIndexRep, 3> & index) const
{
  Point<TCoordRep, 3> point;
  this->TransformContinuousIndexToPhysicalPoint(index, point);
  return point;
}

template <typename TPixel>
template <typename TCoordRep>
void
FCCImage<TPixel>::TransformIndexToPhysicalPoint(const IndexType & index, Point<TCoordRep, 3> & point) const
{
  const SiteType site = FCCLattice::SiteOf(index);
  point = this->template TransformLatticeToPhysicalPoint<TCoordRep>(
    { static_cast<double>(site[0]), static_cast<double>(site[1]), static_cast<double>(site[2]) });
}

template <typename TPixel>
template <typename TCoordRep>
Point<TCoordRep, 3>
FCCImage<TPixel>::TransformIndexToPhysicalPoint(const IndexType & index) const
{
  Point<TCoordRep, 3> point;
  this->TransformIndexToPhysicalPoint(index, point);
  return point;
}

template <typename TPixel>
void
FCCImage<TPixel>::Graft(const Self * image)
{
  if (image != nullptr)
  {
    Superclass::Graft(image);
    this->SetPixelContainer(const_cast<typename Superclass::PixelContainer *>(image->GetPixelContainer()));
  }
}

template <typename TPixel>
void
FCCImage<TPixel>::Graft(const DataObject * data)
{
  if (data == nullptr)
  {
    return;
  }
  const auto * const image = dynamic_cast<const Self *>(data);
  if (image == nullptr)
  {
    itkExceptionMacro("Only an FCCImage of the same pixel type can be grafted; got " << data->GetNameOfClass());
  }
  this->Graft(image);
}

} // namespace itk

#endif
