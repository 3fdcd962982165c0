#ifndef rhombicWaveSum_h
#define rhombicWaveSum_h

#include "rhombicReferenceField.h"

#include <cstddef>

namespace rhombic
{

/** Numbers of plane waves are multiples of this, the largest number that a processor computes at once. */
constexpr std::size_t waveBatch = 8;

/** Sums over plane waves at a point, with t = k . p + phase, in waves. */
struct WaveSums
{
  double cosine = 0.0; ///< sum of cos(2 pi t)
  Vector3 sine{};      ///< sum of sin(2 pi t) k
};

/** \param wavesX,wavesY,wavesZ,phases \a count numbers each, a multiple of waveBatch
 *
 * Sines are computed to 1e-11, in SIMD code chosen for the processor at run time; the last bits differ between
 * processors. Nearly all time of an accuracy experiment is spent here: the compiler's own loops take 1.5 times as long
 * for AVX2, and 3.4 times as long for the oldest processors that it supports. */
WaveSums
SumWaves(const double * wavesX,
         const double * wavesY,
         const double * wavesZ,
         const double * phases,
         std::size_t count,
         const Vector3 & point);

} // namespace rhombic

#endif
