#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCEdgeKernels.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCEdgePoints.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t Capacity = FCCEdgeBatch::Capacity;

/** Finds the fractions of the edges at which the line through the values at both ends crosses zero. */
HWY_ATTR void
CrossLinearly(const FCCEdgeBatch & batch, float * HWY_RESTRICT fraction)
{
  for (std::size_t n = 0; n < Capacity; ++n)
  {
    const float t = batch.value[1][n] / (batch.value[1][n] - batch.value[2][n]);
    fraction[n] = t >= 0.0f && t <= 1.0f ? t : 0.5f; // half where an end is infinite or not a number
  }
}

/** Moves the fractions to where the cubic through the four values at -1, 0, 1, 2 crosses zero: Newton's method, kept
 * between the ends by bisection. Six steps leave less than float32 resolves. */
HWY_ATTR void
CrossCubically(const FCCEdgeBatch & batch, float * HWY_RESTRICT fraction)
{
  constexpr int steps = 6;
  for (std::size_t n = 0; n < Capacity; ++n)
  {
    const float before = batch.value[0][n];
    const float first = batch.value[1][n];
    const float second = batch.value[2][n];
    const float after = batch.value[3][n];
    // Newton's form around the edge's middle, from the even and odd parts of the four values.
    const float even = 0.5f * (first + second);
    const float odd = second - first;
    const float evenOuter = 0.5f * (before + after);
    const float oddOuter = (after - before) * (1.0f / 3.0f);
    const float c2 = 0.5f * (evenOuter - even);
    const float c0 = even - 0.25f * c2;
    const float c3 = 0.5f * (oddOuter - odd);
    const float c1 = odd - 0.25f * c3;
    const bool rises = second > first;
    float low = -0.5f;
    float high = 0.5f;
    float x = fraction[n] - 0.5f;
    for (int step = 0; step < steps; ++step)
    {
      const float value = ((c3 * x + c2) * x + c1) * x + c0;
      const float slope = (3.0f * c3 * x + 2.0f * c2) * x + c1;
      const bool isBeyond = (value > 0.0f) == rises;
      high = isBeyond ? x : high;
      low = isBeyond ? low : x;
      const float next = x - value / slope;
      x = next >= low && next <= high ? next : 0.5f * (low + high);
    }
    const bool isCubic = __builtin_fabsf(c2) + __builtin_fabsf(c3) <= std::numeric_limits<float>::max();
    fraction[n] = isCubic ? x + 0.5f : fraction[n]; // else a value nearby is infinite or not a number
  }
}

/** Finds the fractions of the edges at which the points lie. */
HWY_ATTR void
FindFractions(const FCCEdgeBatch & batch, bool cubic, float minimumFraction, float * HWY_RESTRICT fraction)
{
  CrossLinearly(batch, fraction);
  if (cubic)
  {
    CrossCubically(batch, fraction);
  }
  for (std::size_t n = 0; n < Capacity; ++n)
  {
    const float t = fraction[n] < minimumFraction ? minimumFraction : fraction[n];
    fraction[n] = t > 1.0f - minimumFraction ? 1.0f - minimumFraction : t;
  }
}

/** Writes the coordinates of a batch point by point. */
HWY_ATTR void
Interleave(const float (&coordinates)[3][Capacity], SizeValueType count, float * HWY_RESTRICT points)
{
  for (std::size_t n = 0; n < count; ++n)
  {
    points[3 * n] = coordinates[0][n];
    points[3 * n + 1] = coordinates[1][n];
    points[3 * n + 2] = coordinates[2][n];
  }
}

/** Points in the world at fractions of the edges. */
HWY_ATTR void
PlacePoints(const FCCEdgeBatch & batch,
            const FCCFrame & frame,
            const float * HWY_RESTRICT fraction,
            float (&world)[3][Capacity])
{
  alignas(64) double lattice[3][Capacity];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t n = 0; n < Capacity; ++n)
    {
      lattice[axis][n] =
        batch.site[axis][n] + static_cast<double>(fraction[n]) * static_cast<double>(batch.step[axis][n]);
    }
  }
  for (int row = 0; row < 3; ++row)
  {
    const double a = frame.matrix[row][0];
    const double b = frame.matrix[row][1];
    const double c = frame.matrix[row][2];
    const double d = frame.origin[row];
    for (std::size_t n = 0; n < Capacity; ++n)
    {
      world[row][n] = static_cast<float>(((a * lattice[0][n] + b * lattice[1][n]) + c * lattice[2][n]) + d);
    }
  }
}

/** Directions that point outside in lattice coordinates, of any length: the gradients interpolated along the edges. */
HWY_ATTR void
FindOutwards(const FCCEdgeBatch & batch,
             float sign,
             const float * HWY_RESTRICT fraction,
             float (&outwards)[3][Capacity])
{
  const hn::CappedTag<float, Capacity> tag;
  for (std::size_t n = 0; n < Capacity; n += hn::Lanes(tag))
  {
    hn::Vec<decltype(tag)> first[4];
    hn::Vec<decltype(tag)> second[4];
    hn::LoadInterleaved4(tag, batch.gradient[0][n], first[0], first[1], first[2], first[3]);
    hn::LoadInterleaved4(tag, batch.gradient[1][n], second[0], second[1], second[2], second[3]);
    const auto t = hn::Load(tag, fraction + n);
    const auto rest = hn::Sub(hn::Set(tag, 1.0f), t);
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto gradient = hn::Add(hn::Mul(rest, first[axis]), hn::Mul(t, second[axis]));
      hn::Store(hn::Mul(hn::Set(tag, sign), gradient), tag, outwards[axis] + n);
    }
  }
  for (std::size_t n = 0; n < Capacity; ++n)
  {
    const float x = __builtin_fabsf(outwards[0][n]);
    const float y = __builtin_fabsf(outwards[1][n]);
    const float z = __builtin_fabsf(outwards[2][n]);
    const float xy = x > y ? x : y;
    const float largest = xy > z ? xy : z;
    const float sum = (x + y) + z;
    // In a flat or undefined neighbourhood, the values change along the edge at least.
    const bool isUsable = sum > 0.0f && sum <= std::numeric_limits<float>::max();
    const float along = batch.value[2][n] >= batch.value[1][n] ? sign : -sign;
    const float scale = isUsable ? 1.0f / largest : along; // so that squares neither vanish nor overflow
    for (int axis = 0; axis < 3; ++axis)
    {
      outwards[axis][n] = scale * (isUsable ? outwards[axis][n] : batch.step[axis][n]);
    }
  }
}

/** Unit normals in the world. */
HWY_ATTR void
TurnToWorld(const FCCFrame & frame, const float (&outwards)[3][Capacity], float (&world)[3][Capacity])
{
  for (int row = 0; row < 3; ++row)
  {
    const auto a = static_cast<float>(frame.gradientToWorld[row][0]);
    const auto b = static_cast<float>(frame.gradientToWorld[row][1]);
    const auto c = static_cast<float>(frame.gradientToWorld[row][2]);
    for (std::size_t n = 0; n < Capacity; ++n)
    {
      world[row][n] = (a * outwards[0][n] + b * outwards[1][n]) + c * outwards[2][n];
    }
  }
  for (std::size_t n = 0; n < Capacity; ++n)
  {
    const float squared = (world[0][n] * world[0][n] + world[1][n] * world[1][n]) + world[2][n] * world[2][n];
    const float inverse = 1.0f / __builtin_sqrtf(squared);
    world[0][n] *= inverse;
    world[1][n] *= inverse;
    world[2][n] *= inverse;
  }
}

HWY_ATTR void
PlaceOnEdges(const FCCEdgeBatch & batch,
             const FCCFrame & frame,
             bool cubic,
             double minimumFraction,
             float * HWY_RESTRICT points,
             float * HWY_RESTRICT normals)
{
  alignas(64) float fraction[Capacity];
  FindFractions(batch, cubic, static_cast<float>(minimumFraction), fraction);
  alignas(64) float world[3][Capacity];
  PlacePoints(batch, frame, fraction, world);
  Interleave(world, batch.count, points);
  if (normals != nullptr)
  {
    alignas(64) float outwards[3][Capacity];
    FindOutwards(batch, static_cast<float>(frame.outwardSign), fraction, outwards);
    TurnToWorld(frame, outwards, world);
    Interleave(world, batch.count, normals);
  }
}

} // namespace
} // namespace HWY_NAMESPACE
} // namespace itk
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace itk
{
namespace
{
HWY_EXPORT(PlaceOnEdges);
}

void
PlaceOnEdges(const FCCEdgeBatch & batch,
             const FCCFrame & frame,
             bool cubic,
             double minimumFraction,
             TriangleSurface::PointType * points,
             TriangleSurface::NormalType * normals)
{
  if (batch.count > 0)
  {
    HWY_DYNAMIC_DISPATCH(PlaceOnEdges)
    (batch, frame, cubic, minimumFraction, points->data(), normals != nullptr ? normals->data() : nullptr);
  }
}

} // namespace itk
#endif
