#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCPointKernels.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCLattice.h"
#include "itkFCCPointKernels.h"

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

/** Fractions of the edges at which the line through the values at both ends crosses zero. */
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

HWY_ATTR void
PlaceOnEdges(const FCCEdgeBatch & batch,
             const FCCFrame & frame,
             bool cubic,
             double minimumFraction,
             float * HWY_RESTRICT points,
             float * HWY_RESTRICT normals)
{
  alignas(64) float fraction[Capacity];
  CrossLinearly(batch, fraction);
  if (cubic)
  {
    CrossCubically(batch, fraction);
  }
  const auto least = static_cast<float>(minimumFraction);
  for (std::size_t n = 0; n < Capacity; ++n)
  {
    const float t = fraction[n] < least ? least : fraction[n];
    fraction[n] = t > 1.0f - least ? 1.0f - least : t;
  }

  alignas(64) double lattice[3][Capacity];
  for (int axis = 0; axis < 3; ++axis)
  {
    for (std::size_t n = 0; n < Capacity; ++n)
    {
      lattice[axis][n] =
        batch.site[axis][n] + static_cast<double>(fraction[n]) * static_cast<double>(batch.step[axis][n]);
    }
  }
  alignas(64) float world[3][Capacity];
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
  for (std::size_t n = 0; n < batch.count; ++n)
  {
    points[3 * n] = world[0][n];
    points[3 * n + 1] = world[1][n];
    points[3 * n + 2] = world[2][n];
  }
  if (normals == nullptr)
  {
    return;
  }

  alignas(64) float outwards[3][Capacity];
  const auto sign = static_cast<float>(frame.outwardSign);
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
  for (std::size_t n = 0; n < batch.count; ++n)
  {
    normals[3 * n] = world[0][n];
    normals[3 * n + 1] = world[1][n];
    normals[3 * n + 2] = world[2][n];
  }
}

/** What a batch's sites own, a lane each. */
struct ClusterCrossings
{
  alignas(64) float mean[3][FCCClusterBatch::Capacity];     ///< of the crossings, from the site
  alignas(64) float fraction[FCCClusterBatch::Capacity];    ///< of the edges before their crossings, the mean
  alignas(64) float along[3][FCCClusterBatch::Capacity];    ///< sum of the edges' steps
  alignas(64) float changing[3][FCCClusterBatch::Capacity]; ///< the same, each by how much the values change along it
};

/** Directions to the four sites around the middle of the edge along x, and of its opposite. */
constexpr unsigned int AroundMiddle[2][4] = { { 1, 3, 9, 11 }, { 2, 4, 8, 10 } };

/** Finds the crossings of parabolas with zero, one for each edge: through the values before, at and after the site, but
 * for edges along x, where sites are further apart, through those at the ends and the mean around the middle. */
HWY_ATTR void
FindCrossings(const FCCClusterBatch & batch, ClusterCrossings & crossings)
{
  const hn::CappedTag<float, FCCClusterBatch::Capacity> tag;
  const hn::RebindToUnsigned<decltype(tag)> unsignedTag;
  using Lanes = hn::Vec<decltype(tag)>;
  const Lanes zero = hn::Zero(tag);
  const Lanes half = hn::Set(tag, 0.5f);
  const Lanes one = hn::Set(tag, 1.0f);
  const Lanes least = hn::Set(tag, batch.minimumFraction);
  for (std::size_t n = 0; n < FCCClusterBatch::Capacity; n += hn::Lanes(tag))
  {
    const Lanes value = hn::LoadU(tag, batch.value + n);
    const auto owned = hn::LoadU(unsignedTag, batch.owned + n);
    Lanes count = zero;
    Lanes way = zero;
    Lanes sum[3] = { zero, zero, zero };
    Lanes along[3] = { zero, zero, zero };
    Lanes changing[3] = { zero, zero, zero };
    for (unsigned int direction = 0; direction < FCCClusterBatch::Directions; ++direction)
    {
      const bool isAlongX = direction % 7 == 0;
      const unsigned int opposite = (direction + 7) % FCCClusterBatch::Directions;
      const Lanes after = hn::LoadU(tag, batch.neighbor[direction] + n);
      Lanes before = hn::LoadU(tag, batch.neighbor[opposite] + n);
      if (isAlongX)
      {
        const unsigned int(&around)[4] = AroundMiddle[direction / 7];
        const auto at = [&](unsigned int place) { return hn::LoadU(tag, batch.neighbor[around[place]] + n); };
        const Lanes sum4 = hn::Add(hn::Add(at(0), at(1)), hn::Add(at(2), at(3)));
        const Lanes ends = hn::Add(hn::Mul(hn::Set(tag, 6.0f), value), hn::Mul(hn::Set(tag, 3.0f), after));
        before = hn::Sub(ends, hn::Add(sum4, sum4));
      }
      const Lanes change = hn::Sub(after, value);
      const Lanes curvature = hn::Sub(hn::Mul(half, hn::Add(after, before)), value);
      const Lanes slope = hn::Mul(half, hn::Sub(after, before));
      const Lanes discriminant = hn::Sub(hn::Mul(slope, slope), hn::Mul(hn::Mul(hn::Set(tag, 4.0f), curvature), value));
      const Lanes root = hn::Sqrt(hn::IfThenElseZero(hn::Ge(discriminant, zero), discriminant));
      const Lanes turned = hn::IfThenElse(hn::Gt(change, zero), root, hn::Neg(root));
      const Lanes parabolic = hn::Div(hn::Mul(hn::Set(tag, -2.0f), value), hn::Add(slope, turned));
      const Lanes linear = hn::Div(hn::Neg(value), change);
      const auto isParabolic = hn::And(hn::Ge(parabolic, zero), hn::Le(parabolic, one));
      const Lanes crossing = hn::IfThenElse(isParabolic, parabolic, linear);
      const auto isNear = hn::And(hn::Ge(crossing, zero), hn::Le(crossing, isAlongX ? hn::Sub(one, least) : half));
      const Lanes apart = hn::IfThenElse(hn::Ge(crossing, least), crossing, least);
      const Lanes fraction = hn::IfThenElse(isNear, apart, half);

      const auto bit = hn::Set(unsignedTag, 1U << direction);
      const auto owns = hn::RebindMask(tag, hn::Eq(hn::And(owned, bit), bit));
      const Lanes ownFraction = hn::IfThenElseZero(owns, fraction);
      const Lanes ownStep = hn::IfThenElseZero(owns, one);
      const Lanes ownChange = hn::IfThenElseZero(owns, change);
      count = hn::Add(count, ownStep);
      way = hn::Add(way, ownFraction);
      const auto & step = FCCLattice::OwnedEdges[direction % 7];
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const auto component = hn::Set(tag, static_cast<float>(direction < 7 ? step[axis] : -step[axis]));
        sum[axis] = hn::Add(sum[axis], hn::Mul(ownFraction, component));
        along[axis] = hn::Add(along[axis], hn::Mul(ownStep, component));
        changing[axis] = hn::Add(changing[axis], hn::Mul(ownChange, component));
      }
    }
    hn::Store(hn::Div(way, count), tag, crossings.fraction + n);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      hn::Store(hn::Div(sum[axis], count), tag, crossings.mean[axis] + n);
      hn::Store(along[axis], tag, crossings.along[axis] + n);
      hn::Store(changing[axis], tag, crossings.changing[axis] + n);
    }
  }
}

HWY_ATTR void
PlaceClusters(const FCCClusterBatch & batch,
              const FCCFrame & frame,
              float * HWY_RESTRICT points,
              float * HWY_RESTRICT normals)
{
  constexpr std::size_t lanes = FCCClusterBatch::Capacity;
  ClusterCrossings crossings;
  FindCrossings(batch, crossings);

  alignas(64) float second[6][lanes]; // differences along (1,1,0), (-1,1,0), (1,0,1), (-1,0,1), (0,1,1), (0,-1,1)
  for (unsigned int pair = 0; pair < 6; ++pair)
  {
    for (std::size_t n = 0; n < lanes; ++n)
    {
      second[pair][n] = (batch.neighbor[1 + pair][n] + batch.neighbor[8 + pair][n]) - 2.0f * batch.value[n];
    }
  }
  alignas(64) float outwards[3][lanes];
  alignas(64) float lattice[3][lanes];
  for (std::size_t n = 0; n < lanes; ++n)
  {
    const float a = second[0][n];
    const float b = second[1][n];
    const float c = second[2][n];
    const float d = second[3][n];
    const float e = second[4][n];
    const float f = second[5][n];
    const float xy = 0.25f * (a - b);
    const float xz = 0.25f * (c - d);
    const float yz = 0.25f * (e - f);
    const float p = a + b;
    const float q = c + d;
    const float r = e + f;
    const float xx = 0.25f * ((p + q) - r);
    const float yy = 0.25f * ((p + r) - q);
    const float zz = 0.25f * ((q + r) - p);

    const float g0 = batch.gradient[0][n];
    const float g1 = batch.gradient[1][n];
    const float g2 = batch.gradient[2][n];
    const float startX = crossings.mean[0][n];
    const float startY = crossings.mean[1][n];
    const float startZ = crossings.mean[2][n];

    // Triangles between points on a curved surface lie on one side of it. They straddle it when the expansion's mean
    // over them vanishes, not its value at their corners: of an equilateral triangle these differ by 1/16 of its
    // squared side, 1.6 in lattice coordinates on average, times the sum of the second derivatives along the surface.
    constexpr float straddling = 1.6f / 16.0f;
    const float sx = g0 + ((xx * startX + xy * startY) + xz * startZ);
    const float sy = g1 + ((xy * startX + yy * startY) + yz * startZ);
    const float sz = g2 + ((xz * startX + yz * startY) + zz * startZ);
    const float turnX = (xx * sx + xy * sy) + xz * sz;
    const float turnY = (xy * sx + yy * sy) + yz * sz;
    const float turnZ = (xz * sx + yz * sy) + zz * sz;
    const float across = ((turnX * sx + turnY * sy) + turnZ * sz) / ((sx * sx + sy * sy) + sz * sz);
    const float level = batch.value[n] - straddling * (((xx + yy) + zz) - across);

    float x = startX;
    float y = startY;
    float z = startZ;
    constexpr int steps = 3;
    for (int step = 0; step < steps; ++step)
    {
      const float hx = (xx * x + xy * y) + xz * z;
      const float hy = (xy * x + yy * y) + yz * z;
      const float hz = (xz * x + yz * y) + zz * z;
      const float gx = g0 + hx;
      const float gy = g1 + hy;
      const float gz = g2 + hz;
      const float value = level + (((g0 + 0.5f * hx) * x + (g1 + 0.5f * hy) * y) + (g2 + 0.5f * hz) * z);
      const float length = value / ((gx * gx + gy * gy) + gz * gz);
      x -= length * gx;
      y -= length * gy;
      z -= length * gz;
    }
    const float farthest = batch.farthest * 1.41421356f;
    const float moveX = x - startX;
    const float moveY = y - startY;
    const float moveZ = z - startZ;
    const float moved = (moveX * moveX + moveY * moveY) + moveZ * moveZ;
    const bool isUsable = moved <= farthest * farthest;
    lattice[0][n] = isUsable ? x : startX;
    lattice[1][n] = isUsable ? y : startY;
    lattice[2][n] = isUsable ? z : startZ;

    // The expansion's gradient is the most accurate one where it agrees with that interpolated along the edges.
    const float ex = g0 + ((xx * x + xy * y) + xz * z);
    const float ey = g1 + ((xy * x + yy * y) + yz * z);
    const float ez = g2 + ((xz * x + yz * y) + zz * z);
    const float t = crossings.fraction[n];
    const float ix = (1.0f - t) * g0 + t * batch.farGradient[0][n];
    const float iy = (1.0f - t) * g1 + t * batch.farGradient[1][n];
    const float iz = (1.0f - t) * g2 + t * batch.farGradient[2][n];
    constexpr float agreement = 0.75f; // squared cosine of the largest angle between the two
    const float product = (ex * ix + ey * iy) + ez * iz;
    const float squares = ((ex * ex + ey * ey) + ez * ez) * ((ix * ix + iy * iy) + iz * iz);
    const bool agree = isUsable & (product > 0.0f) & (product * product >= agreement * squares);
    const float nx = agree ? ex : ix;
    const float ny = agree ? ey : iy;
    const float nz = agree ? ez : iz;
    const float rise = (nx * crossings.along[0][n] + ny * crossings.along[1][n]) + nz * crossings.along[2][n];
    const bool isRising = batch.value[n] < 0.0f; // along the crossed edges
    const bool isPlausible = (isRising & (rise > 0.0f)) | (!isRising & (rise < 0.0f));
    const float gx = isPlausible ? nx : crossings.changing[0][n];
    const float gy = isPlausible ? ny : crossings.changing[1][n];
    const float gz = isPlausible ? nz : crossings.changing[2][n];
    const float sum = (__builtin_fabsf(gx) + __builtin_fabsf(gy)) + __builtin_fabsf(gz);
    const bool hasNormal = sum > 0.0f && sum <= std::numeric_limits<float>::max();
    const float scale = static_cast<float>(frame.outwardSign) / sum;
    // Without a gradient: away from the site if it is inside, towards it otherwise; both is better than nothing.
    const float side =
      batch.value[n] >= 0.0f ? -static_cast<float>(frame.outwardSign) : static_cast<float>(frame.outwardSign);
    outwards[0][n] = hasNormal ? scale * gx : side * (startX + 1e-3f);
    outwards[1][n] = hasNormal ? scale * gy : side * startY;
    outwards[2][n] = hasNormal ? scale * gz : side * startZ;
  }

  alignas(64) float world[3][lanes];
  alignas(64) float normal[3][lanes];
  for (int row = 0; row < 3; ++row)
  {
    const double a = frame.matrix[row][0];
    const double b = frame.matrix[row][1];
    const double c = frame.matrix[row][2];
    const double start = ((a * batch.origin[0] + b * batch.origin[1]) + c * batch.origin[2]) + frame.origin[row];
    const auto p = static_cast<float>(frame.gradientToWorld[row][0]);
    const auto q = static_cast<float>(frame.gradientToWorld[row][1]);
    const auto r = static_cast<float>(frame.gradientToWorld[row][2]);
    for (std::size_t n = 0; n < lanes; ++n)
    {
      const double x = static_cast<double>(batch.site[0][n]) + static_cast<double>(lattice[0][n]);
      const double y = static_cast<double>(batch.site[1][n]) + static_cast<double>(lattice[1][n]);
      const double z = static_cast<double>(batch.site[2][n]) + static_cast<double>(lattice[2][n]);
      world[row][n] = static_cast<float>(((a * x + b * y) + c * z) + start);
      normal[row][n] = (p * outwards[0][n] + q * outwards[1][n]) + r * outwards[2][n];
    }
  }
  for (std::size_t n = 0; n < lanes; ++n)
  {
    const float squared = (normal[0][n] * normal[0][n] + normal[1][n] * normal[1][n]) + normal[2][n] * normal[2][n];
    const float inverse = 1.0f / __builtin_sqrtf(squared);
    for (int row = 0; row < 3; ++row)
    {
      points[3 * n + row] = world[row][n];
      normals[3 * n + row] = normal[row][n] * inverse;
    }
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
HWY_EXPORT(PlaceClusters);
} // namespace

void
FCCPointKernels::PlaceOnEdges(const FCCEdgeBatch & batch,
                              const FCCFrame & frame,
                              bool cubic,
                              double minimumFraction,
                              TriangleSurface::PointType * points,
                              TriangleSurface::NormalType * normals)
{
  if (batch.count == 0)
  {
    return;
  }
  HWY_DYNAMIC_DISPATCH(PlaceOnEdges)
  (batch, frame, cubic, minimumFraction, points->data(), normals != nullptr ? normals->data() : nullptr);
}

void
FCCPointKernels::PlaceClusters(const FCCClusterBatch & batch,
                               const FCCFrame & frame,
                               TriangleSurface::PointType (&points)[FCCClusterBatch::Capacity],
                               TriangleSurface::NormalType (&normals)[FCCClusterBatch::Capacity])
{
  HWY_DYNAMIC_DISPATCH(PlaceClusters)(batch, frame, points[0].data(), normals[0].data());
}

} // namespace itk
#endif
