#include "rhombicComparisonSteps.h"

#include "rhombicView.h"

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

const Ink outlineInk{ { 0.1, 0.1, 0.1 } };
const Ink grey{ { 0.62, 0.62, 0.62 } };
const Colour blue{ 0.45, 0.68, 0.90 };
const Colour orange{ 0.93, 0.55, 0.14 };
const Colour green{ 0.0, 0.62, 0.45 };

/** a + t b */
Vector3
Plus(const Vector3 & a, const Vector3 & b, double t = 1.0)
{
  return { a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2] };
}

/** A dot (one point), a line (two), or a face with its outline. */
struct Shape
{
  std::vector<Vector3> points;
  Ink ink;
  double width = 1.2; ///< of a line; radius of a dot
};

using Shapes = std::vector<Shape>;

/** Shapes in parallel projection about the middle of a panel, the farthest ones first. */
void
DrawShapes(Shapes shapes, const PicturePosition & middle, double scale, const std::string & caption, Drawing & drawing)
{
  const ViewFrame frame = ObliqueView(22.0, 18.0).frame;
  const auto depth = [&frame](const Shape & shape) {
    double sum = 0.0;
    for (const Vector3 & point : shape.points)
    {
      sum += Dot(point, frame.look);
    }
    return sum / static_cast<double>(shape.points.size());
  };
  std::stable_sort(
    shapes.begin(), shapes.end(), [&](const Shape & a, const Shape & b) { return depth(a) > depth(b) + 1e-9; });
  for (const Shape & shape : shapes)
  {
    std::vector<PicturePosition> points;
    for (const Vector3 & point : shape.points)
    {
      points.push_back({ middle.x + scale * Dot(point, frame.right), middle.y - scale * Dot(point, frame.up) });
    }
    if (points.size() == 1)
    {
      drawing.Ellipse(points[0], { shape.width, 0.0 }, { 0.0, shape.width }, shape.ink);
    }
    else if (points.size() == 2)
    {
      drawing.Line(points, { shape.width, shape.ink });
    }
    else
    {
      drawing.Polygon(points, shape.ink);
      drawing.Line(points, { shape.width, outlineInk }, true);
    }
  }
  drawing.Text(
    caption, { middle.x, middle.y + 135.0 }, { 14.0, outlineInk, { {}, 0.0 }, false, Alignment::Centre, 256.0 });
}

/** Eight cubes; corners that are kept are large. */
template <typename TKeeps>
Shapes
Nested(const Colour & colour, const TKeeps & keeps)
{
  Shapes shapes;
  for (int n = 0; n < 27; ++n)
  {
    const Vector3 p{ n % 3 - 1.0, n / 3 % 3 - 1.0, n / 9 - 1.0 };
    const bool isKept = keeps(n % 3 + n / 3 % 3 + n / 9, n % 3 + n / 3 % 3, n / 3 % 3 + n / 9);
    shapes.push_back({ { p }, isKept ? Ink{ colour } : grey, isKept ? 6.0 : 1.5 });
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      Vector3 next = p;
      next[axis] += 1.0;
      if (next[axis] < 2.0)
      {
        shapes.push_back({ { p, next }, grey, 0.8 });
      }
    }
  }
  return shapes;
}

Shapes
Parallelepiped(const Vector3 & origin, const std::array<Vector3, 3> & sides, const Ink & ink)
{
  Shapes shapes;
  for (unsigned int n = 0; n < 3; ++n)
  {
    const Vector3 & a = sides[n];
    const Vector3 & b = sides[(n + 1) % 3];
    for (const Vector3 & p : { origin, Plus(origin, sides[(n + 2) % 3]) })
    {
      shapes.push_back({ { p, Plus(p, a), Plus(Plus(p, a), b), Plus(p, b) }, ink });
    }
  }
  return shapes;
}

Shapes
Tetrahedron(const std::array<Vector3, 4> & p, const Ink & ink)
{
  return { { { p[0], p[1], p[2] }, ink },
           { { p[0], p[1], p[3] }, ink },
           { { p[0], p[2], p[3] }, ink },
           { { p[1], p[2], p[3] }, ink } };
}

/** The rhombic dodecahedron whose six sharper corners are one unit from its centre. */
Shapes
Dodecahedron(const Vector3 & centre, const Ink & ink)
{
  Shapes shapes;
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (const double a : { -1.0, 1.0 })
    {
      for (const double b : { -1.0, 1.0 })
      {
        const auto corner = [&](double first, double second, double third) {
          Vector3 p = centre;
          p[axis] += a * first;
          p[(axis + 1) % 3] += b * second;
          p[(axis + 2) % 3] += third;
          return p;
        };
        shapes.push_back(
          { { corner(1.0, 0.0, 0.0), corner(0.5, 0.5, 0.5), corner(0.0, 1.0, 0.0), corner(0.5, 0.5, -0.5) }, ink });
      }
    }
  }
  return shapes;
}

void
Append(Shapes & shapes, const Shapes & more, const Vector3 & shift = {})
{
  for (Shape shape : more)
  {
    std::transform(shape.points.begin(), shape.points.end(), shape.points.begin(), [&](const Vector3 & p) {
      return Plus(p, shift);
    });
    shapes.push_back(shape);
  }
}

/** Seven cubes, and the dodecahedron between the corners of the middle cube and the centres of the others. */
Shapes
MakingOfDodecahedron()
{
  Shapes shapes = Dodecahedron({}, { blue, 0.45 });
  const auto cube = [](const Vector3 & centre) {
    return Parallelepiped(
      Plus(centre, { -0.5, -0.5, -0.5 }), { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } }, { blue, 0.0 });
  };
  Append(shapes, cube({}));
  for (unsigned int axis = 0; axis < 3; ++axis)
  {
    for (const double side : { -1.0, 1.0 })
    {
      Vector3 centre{};
      centre[axis] = side;
      Append(shapes, cube(centre));
      shapes.push_back({ { centre }, { orange }, 4.0 });
    }
  }
  return shapes;
}

/** The dodecahedron's four parallelepipeds, moved apart. */
Shapes
FourParallelepipeds()
{
  constexpr Vector3 v[]{ { 0.5, 0.5, 0.5 }, { 0.5, -0.5, -0.5 }, { -0.5, 0.5, -0.5 }, { -0.5, -0.5, 0.5 } };
  Shapes shapes;
  for (unsigned int n = 0; n < 4; ++n)
  {
    const std::array<Vector3, 3> sides{ v[(n + 1) % 4], v[(n + 2) % 4], v[(n + 3) % 4] };
    Append(shapes,
           Parallelepiped({}, sides, { n % 2 == 0 ? blue : Colour{ 0.75, 0.85, 0.95 }, 0.9 }),
           { -0.7 * v[n][0], -0.7 * v[n][1], -0.7 * v[n][2] });
  }
  return shapes;
}

/** The six tetrahedra of the parallelepiped between sites of the lattice, from its corner at the origin. */
std::vector<std::array<Vector3, 4>>
SixTetrahedra()
{
  constexpr Vector3 a{ 0, 1, 1 };
  constexpr Vector3 b{ 1, 0, 1 };
  constexpr Vector3 c{ 1, 1, 0 };
  const Vector3 ring[]{ b, c, Plus(a, c), Plus(a, b) };
  std::vector<std::array<Vector3, 4>> tetrahedra{ { Vector3{}, a, b, c },
                                                  { Plus(a, b), Plus(a, c), Plus(b, c), Plus(Plus(a, b), c) } };
  for (unsigned int n = 0; n < 4; ++n)
  {
    tetrahedra.push_back({ a, Plus(b, c), ring[n], ring[(n + 1) % 4] }); // about the octahedron's diagonal along x
  }
  return tetrahedra;
}

Shapes
TetrahedraApart()
{
  Shapes shapes;
  for (const auto & tetrahedron : SixTetrahedra())
  {
    Vector3 away{ -1.0, -1.0, -1.0 }; // from the parallelepiped's middle
    for (const Vector3 & p : tetrahedron)
    {
      away = Plus(away, p, 0.25);
    }
    const bool isRegular = shapes.size() < 8;
    Append(shapes, Tetrahedron(tetrahedron, { isRegular ? orange : blue, 0.8 }), Plus({ -1, -1, -1 }, away, 0.9));
  }
  return shapes;
}

/** Two neighbouring parallelepipeds, moved apart; edges that fall onto each other are orange. */
Shapes
MeetingTetrahedra()
{
  constexpr Vector3 a{ 0, 1, 1 };
  Shapes shapes;
  for (const double side : { -1.0, 1.0 })
  {
    const Vector3 shift = Plus({ -1, -1, -1 }, a, side < 0.0 ? -0.8 : 0.8);
    for (const auto & tetrahedron : SixTetrahedra())
    {
      for (const auto & face : Tetrahedron(tetrahedron, { blue, 0.1 }))
      {
        Append(shapes, { face }, shift);
      }
    }
    const Vector3 p = side < 0.0 ? a : Vector3{}; // the corner of the face that both have
    const Vector3 b = Plus(p, { 1, 0, 1 });
    const Vector3 c = Plus(p, { 1, 1, 0 });
    const Vector3 d = Plus(b, { 1, 1, 0 });
    for (const auto & [from, to] : { std::pair(p, b), { p, c }, { b, d }, { c, d }, { b, c } })
    {
      shapes.push_back({ { Plus(from, shift), Plus(to, shift) }, { orange }, 3.0 });
    }
  }
  return shapes;
}

} // namespace

void
DrawLattices(Drawing & drawing)
{
  constexpr double pitch = LatticeDrawingWidth / 4.0;
  const auto draw = [&](int column, int row, const Shapes & shapes, double scale, const std::string & caption) {
    DrawShapes(shapes, { (column + 0.5) * pitch, 125.0 + 275.0 * row }, scale, caption, drawing);
  };
  drawing.Fill({ 0.0, 0.0, LatticeDrawingWidth, LatticeDrawingHeight }, { { 1.0, 1.0, 1.0 } });
  draw(0, 0, Nested(blue, [](int, int, int) { return true; }), 68.0, "Cartesian: every sample");
  draw(1, 0, Nested(orange, [](int xyz, int, int) { return xyz % 2 == 0; }), 68.0, "FCC: every second one");
  draw(
    2, 0, Nested(green, [](int, int xy, int yz) { return xy % 2 == 0 && yz % 2 == 0; }), 68.0, "BCC: every fourth one");
  draw(3, 0, MakingOfDodecahedron(), 65.0, "rhombic dodecahedron from seven cubes");
  Shapes tiling;
  for (const Vector3 & centre :
       { Vector3{ 0, 0, 0 }, { 1, 0, 1 }, { -1, 0, 1 }, { 0, -1, 1 }, { 1, -1, 0 }, { -1, -1, 0 } })
  {
    Append(tiling, Dodecahedron(centre, { blue }), { 0.0, 0.5, -0.5 });
  }
  draw(0, 1, tiling, 54.0, "they fill space");
  draw(1, 1, FourParallelepipeds(), 74.0, "one is four parallelepipeds");
  draw(2, 1, TetrahedraApart(), 54.0, "one of samples is six tetrahedra");
  draw(3, 1, MeetingTetrahedra(), 50.0, "neighbours meet edge on edge");
}

} // namespace rhombic
