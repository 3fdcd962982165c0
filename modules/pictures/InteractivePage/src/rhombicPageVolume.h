#ifndef rhombicPageVolume_h
#define rhombicPageVolume_h

#include "rhombicScan.h"
#include "rhombicSlicePlane.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rhombic
{

/** \class PageVolume
 * \brief The values of a scan on a grid along the patient's axes, as numbers of levels in one byte.
 *
 * Samples are in the order x (towards the patient's left), y (towards the back), z (towards the head). 0 stands for
 * places outside of the scan. */
struct PageVolume
{
  std::array<int, 3> size{};
  Vector3 origin{};           ///< LPS mm of the first sample
  Vector3 spacing{};          ///< mm
  std::vector<double> levels; ///< the value of number 1, 2, ...; rising
  double largestError = 0.0;  ///< of values between -200 and 300 HU, or of all values between the levels' ends
  bool isResampled = false;   ///< whether the scan's slices lie otherwise than the grid's
  std::vector<std::uint8_t> numbers;
};

/** Samples a scan: on a grid of its own spacing where that has at most 256 samples on each side, else of so many times
 * that spacing that it has, with the means of samples in between. Values in HU have levels of 12.5 HU up to -200, 4 HU
 * up to 300 and 19 HU up to 1500; other values even levels between the 0.05th and the 99.95th percentile. */
PageVolume
MakePageVolume(const Scan & scan, const SliceBox & box);

/** The volume with levels \a factor times as far from each other, and every \a step-th slice. */
PageVolume
Coarsen(const PageVolume & volume, int factor, int step);

/** The slices in blocks, each a zlib stream. A number is stored as the difference from what its neighbours predict:
 * the median of the left one, the upper one, and left + upper - upper left. */
std::vector<std::string>
EncodeVolume(const PageVolume & volume, int slicesOfBlock);

} // namespace rhombic

#endif
