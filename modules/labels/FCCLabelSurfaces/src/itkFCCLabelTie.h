#ifndef itkFCCLabelTie_h
#define itkFCCLabelTie_h

#include <array>

namespace itk
{

/** Barycentric coordinates of the point of a simplex where the weights of its sites' labels are equal. Where the
 * weights, which are linear, tie outside of the simplex, the point is moved towards the simplex's middle until each
 * coordinate is at least \a least. The middle if they tie nowhere.
 *
 * \param size sites of the simplex: 2, 3 or 4
 * \param weights by site and label: [site][n] is the weight at a site of the label of the n-th site */
std::array<double, 4>
FindFCCLabelTie(unsigned int size, const double (&weights)[4][4], double least);

} // namespace itk

#endif
