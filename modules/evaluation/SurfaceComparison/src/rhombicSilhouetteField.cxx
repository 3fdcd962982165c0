#include "rhombicShapeFields.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace rhombic
{
namespace
{

constexpr unsigned int NumberOfViews = 72;

/** The pictures of an object from all sides. */
class Silhouettes
{
public:
  Silhouettes(const itk::TriangleSurface & object, unsigned int rows)
  {
    double reach = 0.0; // largest distance from the axis
    for (const auto & p : object.GetPoints())
    {
      reach = std::max<double>(reach, std::hypot(p[0], p[1]));
    }
    const auto bounds = object.GetBounds();
    m_PixelSize = (bounds[5] - bounds[4]) / rows;
    m_Rows = static_cast<int>(rows) + 2; // an empty row on each side
    m_Columns = static_cast<int>(std::ceil(2.0 * reach / m_PixelSize)) + 2;
    m_Bottom = bounds[4] - 0.5 * m_PixelSize;
    m_Left = -0.5 * (m_Columns - 1) * m_PixelSize;
    m_Pixels.resize(std::size_t{ NumberOfViews } * static_cast<std::size_t>(m_Rows * m_Columns));
    for (unsigned int view = 0; view < NumberOfViews; ++view)
    {
      const double angle = 2.0 * 3.14159265358979324 * view / NumberOfViews;
      m_Axes.push_back({ std::cos(angle), std::sin(angle), 0.0 });
      this->Draw(object, view);
    }
  }

  double
  Evaluate(const Vector3 & point, Vector3 & gradient) const
  {
    double least = 2.0;
    for (unsigned int view = 0; view < NumberOfViews && least > 0.0; ++view)
    {
      const auto [u, v] = this->Project(point, view);
      if (!(u >= 0.0 && v >= 0.0 && u < m_Columns - 1 && v < m_Rows - 1))
      {
        gradient = {};
        return -0.5;
      }
      const int column = static_cast<int>(u);
      const int row = static_cast<int>(v);
      const double a = u - column;
      const double b = v - row;
      const std::uint8_t * const p =
        m_Pixels.data() +
        (std::size_t{ view } * static_cast<std::size_t>(m_Rows) + static_cast<std::size_t>(row)) *
          static_cast<std::size_t>(m_Columns) +
        column;
      const std::uint8_t * const q = p + m_Columns;
      const double value = (1.0 - b) * ((1.0 - a) * p[0] + a * p[1]) + b * ((1.0 - a) * q[0] + a * q[1]);
      if (value < least)
      {
        least = value;
        const double alongU = ((1.0 - b) * (p[1] - p[0]) + b * (q[1] - q[0])) / m_PixelSize;
        const double alongV = ((1.0 - a) * (q[0] - p[0]) + a * (q[1] - p[1])) / m_PixelSize;
        gradient = { alongU * m_Axes[view][0], alongU * m_Axes[view][1], alongV };
      }
    }
    return least - 0.5;
  }

private:
  /** Sets the pixels whose centre is in the projection of a triangle. */
  void
  Draw(const itk::TriangleSurface & object, unsigned int view)
  {
    std::uint8_t * const picture = m_Pixels.data() + std::size_t{ view } * static_cast<std::size_t>(m_Rows * m_Columns);
    for (const auto & ids : object.GetTriangles())
    {
      std::array<std::array<double, 2>, 3> c;
      std::transform(ids.begin(), ids.end(), c.begin(), [&](std::uint32_t id) {
        const auto & p = object.GetPoints()[id];
        return this->Project({ p[0], p[1], p[2] }, view);
      });
      const auto [left, right] = std::minmax({ c[0][0], c[1][0], c[2][0] });
      const auto [bottom, top] = std::minmax({ c[0][1], c[1][1], c[2][1] });
      for (int v = static_cast<int>(std::ceil(bottom)); v <= top; ++v)
      {
        for (int u = static_cast<int>(std::ceil(left)); u <= right; ++u)
        {
          const auto side = [&](unsigned int a, unsigned int b) {
            return (c[b][0] - c[a][0]) * (v - c[a][1]) - (c[b][1] - c[a][1]) * (u - c[a][0]);
          };
          const auto [least, most] = std::minmax({ side(0, 1), side(1, 2), side(2, 0) });
          if (least >= 0.0 || most <= 0.0)
          {
            picture[v * m_Columns + u] = 1;
          }
        }
      }
    }
  }

  /** A point in a picture, in pixels from the centre of the first pixel. */
  std::array<double, 2>
  Project(const Vector3 & point, unsigned int view) const
  {
    return { (Dot(point, m_Axes[view]) - m_Left) / m_PixelSize, (point[2] - m_Bottom) / m_PixelSize };
  }

  double m_PixelSize;
  double m_Left; ///< position of the first pixel's centre
  double m_Bottom;
  int m_Columns;
  int m_Rows;
  std::vector<Vector3> m_Axes;        ///< the horizontal axis of each view
  std::vector<std::uint8_t> m_Pixels; ///< of all pictures, 0 or 1
};

} // namespace

ReferenceField
MakeSilhouetteField(const itk::TriangleSurface & object, unsigned int rows)
{
  return ReferenceField([pictures = std::make_shared<const Silhouettes>(object, rows)](
                          const Vector3 & point, Vector3 & gradient) { return pictures->Evaluate(point, gradient); });
}

} // namespace rhombic
