#include "itkSeparableTaps.h"

#include "detail/itkFCCMirror.h"
#include "itkMacro.h"
#include "itkMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>

namespace itk
{
namespace
{

constexpr std::size_t CubicTaps = 10;
constexpr OffsetValueType CubicBefore = CubicTaps / 2 - 1;
constexpr std::size_t Knots = 4; // cubic B-splines that are not 0 at a position

/** Weights of the samples from floor(position) - before on, of an axis without ends. */
struct Kernel
{
  OffsetValueType before;
  std::size_t count;
  std::array<double, CubicTaps> weights{}; // more than count are 0
};

Kernel
LinearKernel(double fraction)
{
  return { 0, 2, { 1.0 - fraction, fraction } };
}

/** Solves a small system of equations by Gauss-Jordan elimination, for several right-hand sides at once. */
template <std::size_t VSize, std::size_t VSides>
std::array<std::array<double, VSides>, VSize>
Solve(std::array<std::array<double, VSize>, VSize> matrix, std::array<std::array<double, VSides>, VSize> sides)
{
  for (std::size_t column = 0; column < VSize; ++column)
  {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < VSize; ++row)
    {
      pivot = std::abs(matrix[row][column]) > std::abs(matrix[pivot][column]) ? row : pivot;
    }
    std::swap(matrix[column], matrix[pivot]);
    std::swap(sides[column], sides[pivot]);
    for (std::size_t row = 0; row < VSize; ++row)
    {
      const double factor = row == column ? 0.0 : matrix[row][column] / matrix[column][column];
      for (std::size_t n = 0; n < VSize; ++n)
      {
        matrix[row][n] -= factor * matrix[column][n];
      }
      for (std::size_t n = 0; n < VSides; ++n)
      {
        sides[row][n] -= factor * sides[column][n];
      }
    }
  }
  for (std::size_t row = 0; row < VSize; ++row)
  {
    for (double & value : sides[row])
    {
      value /= matrix[row][row];
    }
  }
  return sides;
}

/** The prefilter cut to the taps: [tap][knot] is the weight of a sample in the coefficient of a B-spline.
 *
 * Uncut, the coefficient of knot k has the frequency response e^{i w k} / B(w), B(w) = (2 + cos w) / 3. Each column is
 * the sequence of ten that comes closest to that in least squares over |w| <= pi, weighted with (1 - (w / pi)^2)^3 for
 * the low frequencies that images mostly have, among those with its moments of degree 0 to 3. The moments make the
 * kernel exact for cubics. Where the uncut kernel is a unit impulse, at the samples, the cut kernel is, too, so that it
 * interpolates and is continuous. */
std::array<std::array<double, Knots>, CubicTaps>
CutPrefilter()
{
  constexpr std::size_t moments = 4;
  constexpr std::size_t unknowns = CubicTaps + moments; // weights and Lagrange multipliers
  std::array<std::array<double, unknowns>, unknowns> matrix{};
  std::array<std::array<double, Knots>, unknowns> sides{};

  const auto offsetOf = [](std::size_t tap) { return static_cast<double>(tap) - CubicBefore; };
  const auto knotAt = [](std::size_t knot) { return static_cast<double>(knot) - 1.0; };
  constexpr int frequencies = 256;
  for (int n = 0; n < frequencies; ++n)
  {
    const double part = (n + 0.5) / frequencies;
    const double w = Math::pi * part;
    const double band = 1.0 - part * part;
    const double weight = band * band * band / frequencies;
    const double response = 3.0 / (2.0 + std::cos(w));
    for (std::size_t tap = 0; tap < CubicTaps; ++tap)
    {
      for (std::size_t other = 0; other < CubicTaps; ++other)
      {
        matrix[tap][other] += weight * std::cos(w * (offsetOf(tap) - offsetOf(other)));
      }
      for (std::size_t knot = 0; knot < Knots; ++knot)
      {
        sides[tap][knot] += weight * response * std::cos(w * (offsetOf(tap) - knotAt(knot)));
      }
    }
  }
  for (std::size_t tap = 0; tap < CubicTaps; ++tap)
  {
    double power = 1.0;
    for (std::size_t degree = 0; degree < moments; ++degree, power *= offsetOf(tap))
    {
      matrix[tap][CubicTaps + degree] = power;
      matrix[CubicTaps + degree][tap] = power;
    }
  }
  for (std::size_t knot = 0; knot < Knots; ++knot)
  {
    // 1 / B(w) = 1 + w^2 / 6 + ...: second moment -1/3 about the knot, no odd moments.
    const double k = knotAt(knot);
    sides[CubicTaps][knot] = 1.0;
    sides[CubicTaps + 1][knot] = k;
    sides[CubicTaps + 2][knot] = k * k - 1.0 / 3.0;
    sides[CubicTaps + 3][knot] = k * k * k - k;
  }

  const auto solution = Solve(matrix, sides);
  std::array<std::array<double, Knots>, CubicTaps> prefilter;
  std::copy_n(solution.begin(), CubicTaps, prefilter.begin());
  return prefilter;
}

Kernel
CubicBSplineKernel(double fraction)
{
  static const auto prefilter = CutPrefilter();
  const double t = fraction;
  const double u = 1.0 - fraction;
  const double spline[Knots] = {
    u * u * u / 6.0, 2.0 / 3.0 - t * t * (2.0 - t) / 2.0, 2.0 / 3.0 - u * u * (2.0 - u) / 2.0, t * t * t / 6.0
  };
  Kernel kernel{ CubicBefore, CubicTaps };
  for (std::size_t tap = 0; tap < CubicTaps; ++tap)
  {
    for (std::size_t knot = 0; knot < Knots; ++knot)
    {
      kernel.weights[tap] += prefilter[tap][knot] * spline[knot];
    }
  }
  return kernel;
}

Kernel
Lanczos4Kernel(double fraction)
{
  constexpr std::size_t radius = 4;
  Kernel kernel{ radius - 1, 2 * radius };
  double sum = 0.0;
  for (std::size_t tap = 0; tap < 2 * radius; ++tap)
  {
    const double x = Math::pi * (static_cast<double>(tap) - (radius - 1) - fraction);
    // sinc(x) sinc(x / radius)
    kernel.weights[tap] = std::abs(x) < 1e-9 ? 1.0 : radius * std::sin(x) * std::sin(x / radius) / (x * x);
    sum += kernel.weights[tap];
  }
  for (double & weight : kernel.weights)
  {
    weight /= sum;
  }
  return kernel;
}

Kernel
MakeKernel(SeparableKernel kernel, double fraction)
{
  switch (kernel)
  {
    case SeparableKernel::Linear:
      return LinearKernel(fraction);
    case SeparableKernel::CubicBSpline:
      return CubicBSplineKernel(fraction);
    case SeparableKernel::Lanczos4:
      return Lanczos4Kernel(fraction);
  }
  itkGenericExceptionMacro("There is no such SeparableKernel: " << static_cast<int>(kernel) << ".");
}

/** Whether the step from sample \a n to the next is so much longer than the step before or after that a spline would
 * overshoot. */
bool
IsAbrupt(const std::vector<double> & samples, std::size_t n)
{
  constexpr double ratio = 2.5;
  const double step = samples[n + 1] - samples[n];
  return (n > 0 && step > ratio * (samples[n] - samples[n - 1])) ||
         (n + 2 < samples.size() && step > ratio * (samples[n + 2] - samples[n + 1]));
}

/** The weights of \a count samples, from \a first on, in the natural cubic spline through them at a position between
 * samples \a n and \a n + 1.
 *
 * The spline is a f[n] + b f[n + 1] + c m[n] + d m[n + 1], where m are its second derivatives, which solve A m = R f
 * with the tridiagonal matrices A and R. A is symmetric, so that c and d are turned into weights by solving A w = (c,
 * d). */
std::vector<double>
NaturalSplineWeights(const std::vector<double> & samples,
                     std::size_t first,
                     std::size_t count,
                     std::size_t n,
                     double position)
{
  const double * const x = samples.data() + first;
  const std::size_t lower = n - first;
  const double step = x[lower + 1] - x[lower];
  const double b = (position - x[lower]) / step;
  const double a = 1.0 - b;
  std::vector<double> weights(count);
  weights[lower] = a;
  weights[lower + 1] = b;

  std::vector<double> sides(count);
  sides[lower] = (a * a * a - a) * step * step / 6.0;
  sides[lower + 1] = (b * b * b - b) * step * step / 6.0;
  std::vector<double> pivots(count);
  for (std::size_t k = 1; k + 1 < count; ++k)
  {
    const double before = x[k] - x[k - 1];
    const double factor = k > 1 ? before / pivots[k - 1] : 0.0;
    pivots[k] = 2.0 * (x[k + 1] - x[k - 1]) - factor * before;
    sides[k] -= k > 1 ? factor * sides[k - 1] : 0.0;
  }
  double next = 0.0;
  for (std::size_t k = count - 1; k-- > 1;)
  {
    const double before = x[k] - x[k - 1];
    const double after = x[k + 1] - x[k];
    next = (sides[k] - after * next) / pivots[k];
    weights[k - 1] += 6.0 / before * next;
    weights[k] -= (6.0 / before + 6.0 / after) * next;
    weights[k + 1] += 6.0 / after * next;
  }
  return weights;
}

} // namespace

std::ostream &
operator<<(std::ostream & os, SeparableKernel kernel)
{
  switch (kernel)
  {
    case SeparableKernel::Linear:
      return os << "Linear";
    case SeparableKernel::CubicBSpline:
      return os << "CubicBSpline";
    case SeparableKernel::Lanczos4:
      return os << "Lanczos4";
  }
  return os << "SeparableKernel(" << static_cast<int>(kernel) << ")";
}

SeparableTaps::SeparableTaps(SeparableKernel kernel, SizeValueType length, const std::vector<double> & positions)
  : m_NumberOfTaps(std::min<SizeValueType>(length, MakeKernel(kernel, 0.0).count))
  , m_First(positions.size())
  , m_Weights(positions.size() * m_NumberOfTaps)
{
  const auto last = static_cast<OffsetValueType>(length) - 1;
  const auto taps = static_cast<OffsetValueType>(m_NumberOfTaps);
  std::vector<double> sums(m_NumberOfTaps);
  for (std::size_t n = 0; n < positions.size(); ++n)
  {
    const double position = std::clamp(positions[n], 0.0, static_cast<double>(last));
    const auto sample = std::min(static_cast<OffsetValueType>(position), std::max<OffsetValueType>(last - 1, 0));
    const Kernel weights = MakeKernel(kernel, position - static_cast<double>(sample));
    const auto first = std::clamp<OffsetValueType>(sample - weights.before, 0, last + 1 - taps);

    std::fill(sums.begin(), sums.end(), 0.0);
    for (std::size_t tap = 0; tap < weights.count; ++tap)
    {
      const auto source = sample - weights.before + static_cast<OffsetValueType>(tap);
      sums[static_cast<std::size_t>(MirrorIntoRange(source, 0, last) - first)] += weights.weights[tap];
    }
    m_First[n] = static_cast<SizeValueType>(first);
    std::transform(sums.begin(),
                   sums.end(),
                   m_Weights.begin() + static_cast<std::ptrdiff_t>(n * m_NumberOfTaps),
                   [](double w) { return static_cast<float>(w); });
  }
}

SeparableTaps::SeparableTaps(SeparableKernel kernel,
                             const std::vector<double> & samples,
                             const std::vector<double> & positions)
  : m_NumberOfTaps(std::min<SizeValueType>(samples.size(), kernel == SeparableKernel::Linear ? 2 : CubicTaps))
  , m_First(positions.size())
  , m_Weights(positions.size() * m_NumberOfTaps)
{
  for (std::size_t n = 0; n < positions.size(); ++n)
  {
    float * const weights = m_Weights.data() + n * m_NumberOfTaps;
    if (samples.size() == 1)
    {
      weights[0] = 1.0f;
      continue;
    }
    const double position = std::clamp(positions[n], samples.front(), samples.back());
    const auto upper = std::upper_bound(samples.begin() + 1, samples.end() - 1, position);
    const auto sample = static_cast<OffsetValueType>(upper - samples.begin()) - 1;
    const auto before = static_cast<OffsetValueType>(m_NumberOfTaps / 2) - 1;
    const auto most = static_cast<OffsetValueType>(samples.size() - m_NumberOfTaps);
    m_First[n] = static_cast<SizeValueType>(std::clamp<OffsetValueType>(sample - before, 0, most));

    const auto lower = static_cast<std::size_t>(sample);
    const bool isLinear = IsAbrupt(samples, lower);
    const auto window =
      NaturalSplineWeights(samples, isLinear ? lower : m_First[n], isLinear ? 2 : m_NumberOfTaps, lower, position);
    const std::size_t start = isLinear ? lower - m_First[n] : 0;
    std::transform(window.begin(), window.end(), weights + start, [](double w) { return static_cast<float>(w); });
  }
}

} // namespace itk
