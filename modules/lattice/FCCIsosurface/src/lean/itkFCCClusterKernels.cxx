#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "itkFCCClusterKernels.cxx"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "itkFCCClusterPoints.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace itk
{
namespace HWY_NAMESPACE
{
namespace
{

namespace hn = hwy::HWY_NAMESPACE;
using Star = FCCCells;

constexpr std::size_t Capacity = FCCClusterBatch::Capacity;

/** The crossings that the vertices of a batch gather, one lane for each vertex. */
struct ClusterCrossings
{
  alignas(64) float mean[3][Capacity];     ///< mean of the crossings, from the site
  alignas(64) float fraction[Capacity];    ///< mean fraction of the edges before their crossings
  alignas(64) float along[3][Capacity];    ///< sum of the edges' steps
  alignas(64) float changing[3][Capacity]; ///< sum of the steps, each times the change of the values along it
};

constexpr unsigned int AlongX = Star::DirectionOf({ 2, 0, 0 });

/** Directions to the four sites around the middle of the edge along x, and of its opposite. */
constexpr unsigned int AroundMiddle[2][4] = { { Star::DirectionOf({ 1, 1, 0 }),
                                                Star::DirectionOf({ 1, 0, 1 }),
                                                Star::DirectionOf({ 1, -1, 0 }),
                                                Star::DirectionOf({ 1, 0, -1 }) },
                                              { Star::DirectionOf({ -1, 1, 0 }),
                                                Star::DirectionOf({ -1, 0, 1 }),
                                                Star::DirectionOf({ -1, -1, 0 }),
                                                Star::DirectionOf({ -1, 0, -1 }) } };

/** Finds the crossings of parabolas with zero, one for each edge: through the values before, at and after the site, but
 * for edges along x, where sites are further apart, through the values at the ends and the mean around the middle. */
HWY_ATTR void
FindCrossings(const FCCClusterBatch & batch, ClusterCrossings & found)
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
    const auto crossings = hn::LoadU(unsignedTag, batch.crossings + n);
    Lanes count = zero;
    Lanes way = zero;
    Lanes sum[3] = { zero, zero, zero };
    Lanes along[3] = { zero, zero, zero };
    Lanes changing[3] = { zero, zero, zero };
    for (unsigned int direction = 0; direction < Star::Directions; ++direction)
    {
      const bool isAlongX = direction == AlongX || direction == Star::OppositeOf(AlongX);
      const Lanes after = hn::LoadU(tag, batch.neighbor[direction] + n);
      Lanes before = hn::LoadU(tag, batch.neighbor[Star::OppositeOf(direction)] + n);
      if (isAlongX)
      {
        const unsigned int(&around)[4] = AroundMiddle[direction == AlongX ? 0 : 1];
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
      const auto isGathered = hn::RebindMask(tag, hn::Eq(hn::And(crossings, bit), bit));
      const Lanes gatheredFraction = hn::IfThenElseZero(isGathered, fraction);
      const Lanes gatheredStep = hn::IfThenElseZero(isGathered, one);
      const Lanes gatheredChange = hn::IfThenElseZero(isGathered, change);
      count = hn::Add(count, gatheredStep);
      way = hn::Add(way, gatheredFraction);
      const auto step = Star::StepOf(direction);
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const auto component = hn::Set(tag, static_cast<float>(step[axis]));
        sum[axis] = hn::Add(sum[axis], hn::Mul(gatheredFraction, component));
        along[axis] = hn::Add(along[axis], hn::Mul(gatheredStep, component));
        changing[axis] = hn::Add(changing[axis], hn::Mul(gatheredChange, component));
      }
    }
    hn::Store(hn::Div(way, count), tag, found.fraction + n);
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      hn::Store(hn::Div(sum[axis], count), tag, found.mean[axis] + n);
      hn::Store(along[axis], tag, found.along[axis] + n);
      hn::Store(changing[axis], tag, found.changing[axis] + n);
    }
  }
}

/** A point, step or gradient in lattice coordinates. */
struct Vector
{
  float x;
  float y;
  float z;
};

HWY_INLINE float
Dot(const Vector & a, const Vector & b)
{
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}

HWY_INLINE Vector
Get(const float (&lanes)[3][Capacity], std::size_t n)
{
  return { lanes[0][n], lanes[1][n], lanes[2][n] };
}

/** The field about a site to the second order: gradient and second derivatives. */
struct Expansion
{
  Vector gradient;
  float xx;
  float yy;
  float zz;
  float xy;
  float xz;
  float yz;

  HWY_INLINE
  Expansion(const FCCClusterBatch & batch, std::size_t n)
    : gradient(Get(batch.gradient, n))
  {
    const auto secondDifference = [&](unsigned int direction) HWY_ATTR {
      return (batch.neighbor[direction][n] + batch.neighbor[Star::OppositeOf(direction)][n]) - 2.0f * batch.value[n];
    };
    constexpr unsigned int directions[6] = { Star::DirectionOf({ 1, 1, 0 }), Star::DirectionOf({ -1, 1, 0 }),
                                             Star::DirectionOf({ 1, 0, 1 }), Star::DirectionOf({ -1, 0, 1 }),
                                             Star::DirectionOf({ 0, 1, 1 }), Star::DirectionOf({ 0, -1, 1 }) };
    const float a = secondDifference(directions[0]);
    const float b = secondDifference(directions[1]);
    const float c = secondDifference(directions[2]);
    const float d = secondDifference(directions[3]);
    const float e = secondDifference(directions[4]);
    const float f = secondDifference(directions[5]);
    xy = 0.25f * (a - b);
    xz = 0.25f * (c - d);
    yz = 0.25f * (e - f);
    const float p = a + b;
    const float q = c + d;
    const float r = e + f;
    xx = 0.25f * ((p + q) - r);
    yy = 0.25f * ((p + r) - q);
    zz = 0.25f * ((q + r) - p);
  }

  /** By how much the gradient changes along a step. */
  HWY_INLINE Vector
  TurnAlong(const Vector & step) const
  {
    return { (xx * step.x + xy * step.y) + xz * step.z,
             (xy * step.x + yy * step.y) + yz * step.z,
             (xz * step.x + yz * step.y) + zz * step.z };
  }

  /** The gradient at a position relative to the site. */
  HWY_INLINE Vector
  GradientAt(const Vector & place) const
  {
    const Vector turn = this->TurnAlong(place);
    return { gradient.x + turn.x, gradient.y + turn.y, gradient.z + turn.z };
  }

  /** The level at which triangles with corners near \a place straddle the surface. Triangles between points on a curved
   * surface lie on one side of it. They straddle it when the expansion's mean over them vanishes, not its value at
   * their corners: of an equilateral triangle these differ by 1/16 of its squared side, 1.6 in lattice coordinates on
   * average, times the sum of the second derivatives along the surface. */
  HWY_INLINE float
  FindLevel(float value, const Vector & place) const
  {
    constexpr float straddling = 1.6f / 16.0f;
    const Vector normal = this->GradientAt(place);
    const float across = Dot(this->TurnAlong(normal), normal) / Dot(normal, normal);
    return value - straddling * (((xx + yy) + zz) - across);
  }

  /** Moves a position to where the expansion about a value of \a level at the site vanishes. */
  HWY_INLINE Vector
  Project(float level, Vector place) const
  {
    constexpr int steps = 3;
    for (int step = 0; step < steps; ++step)
    {
      const Vector turn = this->TurnAlong(place);
      const Vector slope{ gradient.x + turn.x, gradient.y + turn.y, gradient.z + turn.z };
      const Vector mean{ gradient.x + 0.5f * turn.x, gradient.y + 0.5f * turn.y, gradient.z + 0.5f * turn.z };
      const float length = (level + Dot(mean, place)) / Dot(slope, slope);
      place = { place.x - length * slope.x, place.y - length * slope.y, place.z - length * slope.z };
    }
    return place;
  }
};

/** A direction that points outside, of any length. \a place is on the surface of the expansion, which
 * counts only if it \a isUsable. */
HWY_INLINE Vector
FindOutwards(const FCCClusterBatch & batch,
             const ClusterCrossings & crossings,
             const Expansion & expansion,
             const Vector & place,
             bool isUsable,
             float outwardSign,
             std::size_t n)
{
  // The expansion's gradient is the most accurate where it agrees with the gradient interpolated along the edges.
  const Vector expanded = expansion.GradientAt(place);
  const float t = crossings.fraction[n];
  const Vector & near = expansion.gradient;
  const Vector far = Get(batch.farGradient, n);
  const Vector interpolated{ (1.0f - t) * near.x + t * far.x,
                             (1.0f - t) * near.y + t * far.y,
                             (1.0f - t) * near.z + t * far.z };
  constexpr float agreement = 0.75f; // squared cosine of the largest angle between the two
  const float product = Dot(expanded, interpolated);
  const float squares = Dot(expanded, expanded) * Dot(interpolated, interpolated);
  const bool agree = isUsable & (product > 0.0f) & (product * product >= agreement * squares);
  const Vector gradient{ agree ? expanded.x : interpolated.x,
                         agree ? expanded.y : interpolated.y,
                         agree ? expanded.z : interpolated.z };
  const float rise = Dot(gradient, Get(crossings.along, n));
  const bool isRising = batch.value[n] < 0.0f; // along the crossed edges
  const bool isPlausible = (isRising & (rise > 0.0f)) | (!isRising & (rise < 0.0f));
  const Vector changing = Get(crossings.changing, n);
  const Vector best{ isPlausible ? gradient.x : changing.x,
                     isPlausible ? gradient.y : changing.y,
                     isPlausible ? gradient.z : changing.z };
  const float sum = (__builtin_fabsf(best.x) + __builtin_fabsf(best.y)) + __builtin_fabsf(best.z);
  const bool hasNormal = sum > 0.0f && sum <= std::numeric_limits<float>::max();
  const float scale = outwardSign / sum;
  // Without a gradient: away from a site inside, towards a site outside; the 1e-3 serves crossings at the site.
  const float side = batch.value[n] >= 0.0f ? -outwardSign : outwardSign;
  const Vector mean = Get(crossings.mean, n);
  return { hasNormal ? scale * best.x : side * (mean.x + 1e-3f),
           hasNormal ? scale * best.y : side * mean.y,
           hasNormal ? scale * best.z : side * mean.z };
}

/** Points and unit normals in the world, written vertex by vertex. */
HWY_ATTR void
TurnToWorld(const FCCClusterBatch & batch,
            const FCCFrame & frame,
            const float (&lattice)[3][Capacity],
            const float (&outwards)[3][Capacity],
            float * HWY_RESTRICT points,
            float * HWY_RESTRICT normals)
{
  alignas(64) float world[3][Capacity];
  alignas(64) float normal[3][Capacity];
  for (int row = 0; row < 3; ++row)
  {
    const double a = frame.matrix[row][0];
    const double b = frame.matrix[row][1];
    const double c = frame.matrix[row][2];
    const double start = ((a * batch.origin[0] + b * batch.origin[1]) + c * batch.origin[2]) + frame.origin[row];
    const auto p = static_cast<float>(frame.gradientToWorld[row][0]);
    const auto q = static_cast<float>(frame.gradientToWorld[row][1]);
    const auto r = static_cast<float>(frame.gradientToWorld[row][2]);
    for (std::size_t n = 0; n < Capacity; ++n)
    {
      const double x = static_cast<double>(batch.site[0][n]) + static_cast<double>(lattice[0][n]);
      const double y = static_cast<double>(batch.site[1][n]) + static_cast<double>(lattice[1][n]);
      const double z = static_cast<double>(batch.site[2][n]) + static_cast<double>(lattice[2][n]);
      world[row][n] = static_cast<float>(((a * x + b * y) + c * z) + start);
      normal[row][n] = (p * outwards[0][n] + q * outwards[1][n]) + r * outwards[2][n];
    }
  }
  for (std::size_t n = 0; n < Capacity; ++n)
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

HWY_ATTR void
PlaceClusters(const FCCClusterBatch & batch,
              const FCCFrame & frame,
              float * HWY_RESTRICT points,
              float * HWY_RESTRICT normals)
{
  ClusterCrossings crossings;
  FindCrossings(batch, crossings);
  alignas(64) float outwards[3][Capacity];
  alignas(64) float lattice[3][Capacity];
  for (std::size_t n = 0; n < Capacity; ++n)
  {
    const Expansion expansion(batch, n);
    const Vector start = Get(crossings.mean, n);
    const Vector projected = expansion.Project(expansion.FindLevel(batch.value[n], start), start);
    const float farthest = batch.farthest * 1.41421356f;
    const Vector move{ projected.x - start.x, projected.y - start.y, projected.z - start.z };
    const bool isUsable = Dot(move, move) <= farthest * farthest;
    const Vector place{ isUsable ? projected.x : start.x,
                        isUsable ? projected.y : start.y,
                        isUsable ? projected.z : start.z };
    lattice[0][n] = place.x;
    lattice[1][n] = place.y;
    lattice[2][n] = place.z;
    const auto outwardSign = static_cast<float>(frame.outwardSign);
    const Vector direction = FindOutwards(batch, crossings, expansion, projected, isUsable, outwardSign, n);
    outwards[0][n] = direction.x;
    outwards[1][n] = direction.y;
    outwards[2][n] = direction.z;
  }
  TurnToWorld(batch, frame, lattice, outwards, points, normals);
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
HWY_EXPORT(PlaceClusters);
}

void
PlaceClusters(const FCCClusterBatch & batch,
              const FCCFrame & frame,
              TriangleSurface::PointType (&points)[FCCClusterBatch::Capacity],
              TriangleSurface::NormalType (&normals)[FCCClusterBatch::Capacity])
{
  HWY_DYNAMIC_DISPATCH(PlaceClusters)(batch, frame, points[0].data(), normals[0].data());
}

} // namespace itk
#endif
