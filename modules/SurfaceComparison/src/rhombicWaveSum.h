#ifndef rhombicWaveSum_h
#define rhombicWaveSum_h

#include "rhombicReferenceField.h"

#include <cstddef>

namespace rhombic
{

/** Plane waves come in multiples of this number, the most that a processor computes at once. */
constexpr std::size_t waveBatch = 8;

/** Sums over plane waves at a point, with t = k . p + phase, in waves. */
struct WaveSums
{
  double cosine = 0.0; ///< of cos(2 pi t)
  Vector3 sine{};      ///< of sin(2 pi t) k
};

/** \param wavesX,wavesY,wavesZ,phases \a count numbers each, a multiple of waveBatch
 *
 * Sines are computed to 1e-11, in SIMD code for the processor at hand; processors differ in the last bits. */
WaveSums
SumWaves(const double * wavesX,
         const double * wavesY,
         const double * wavesZ,
         const double * phases,
         std::size_t count,
         const Vector3 & point);

} // namespace rhombic

#endif
