#ifndef itkFCCNeighborhoodIterator_h
#define itkFCCNeighborhoodIterator_h

#include "itkFCCConstNeighborhoodIterator.h"

namespace itk
{

/** \class FCCNeighborhoodIterator
 * \brief An FCCConstNeighborhoodIterator that can also write the current sample.
 *
 * Neighbours are read only. Values written to earlier samples are the neighbours of later ones; where that is not
 * wanted, write to another image.
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

  /** Writes the current sample. */
  void
  SetCenterPixel(const PixelType & value)
  {
    const_cast<PixelType &>(*this->GetPixelPointer()) = value; // the constructor took a mutable image
  }
};

} // namespace itk

#endif
