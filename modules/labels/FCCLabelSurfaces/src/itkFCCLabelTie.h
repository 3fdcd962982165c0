#ifndef itkFCCLabelTie_h
#define itkFCCLabelTie_h

#include <array>

namespace itk
{

/** \class FCCLabelTie
 * \brief The point of a simplex where the weights of its sites' labels are equal. */
struct FCCLabelTie
{
  static constexpr unsigned int Most = 4;

  unsigned int size; ///< sites: 2, 3 or 4

  /** weights[site][n]: at a site, of the label of the n-th site. */
  double weights[Most][Most];

  /** Barycentric coordinates of the point. Where the weights, which are linear, tie outside of the simplex, the point
   * is moved towards the simplex's middle until each coordinate is at least \a least. The middle if they tie nowhere.
   */
  std::array<double, Most>
  Find(double least) const;
};

} // namespace itk

#endif
