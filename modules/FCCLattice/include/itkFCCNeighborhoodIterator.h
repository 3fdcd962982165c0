#ifndef itkFCCNeighborhoodIterator_h
#define itkFCCNeighborhoodIterator_h

#include "itkFCCConstNeighborhoodIterator.h"

namespace itk
{

/** \class FCCNeighborhoodIterator
 * \brief An FCCConstNeighborhoodIterator that can also change the sample it is at.
 *
 * Neighbours are read only: what is written to one would be seen when the iterator comes there, and by other threads.
 * What was written to earlier samples is seen by later ones; write to another image where that is not wanted.
 *
 * Thread safety: iterators that write need an image, or a region that no other one reads, for themselves.
 *
 * \ingroup FCCLattice
 */
template <typename TImage>
class FCCNeighborhoodIterator : public FCCConstNeighborhoodIterator<TImage>
{
public:
  using Superclass = FCCConstNeighborhoodIterator<TImage>;
  using typename Superclass::PixelType;
  using typename Superclass::RegionType;

  FCCNeighborhoodIterator(TImage * image, const RegionType & region)
    : Superclass(image, region)
  {}

  /** Writes the sample it is at. */
  void
  SetCenterPixel(const PixelType & value)
  {
    const_cast<PixelType &>(*this->GetPixelPointer()) = value; // the image was given as one that may be changed
  }
};

} // namespace itk

#endif
