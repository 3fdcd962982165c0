#include "rhombicPhantomAnatomy.h"

#include "itkMath.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

// Every length is in millimetres. The body stands on z = 0 and is 700 tall: a head, a neck and a trunk down to the
// hips. Where a number looks arbitrary, it places one part clear of its neighbours.

namespace rhombic
{
namespace
{

using itk::Math::pi;
using Parts = std::vector<PhantomPart>;
using LoftPointer = std::shared_ptr<const PhantomLoft>;

constexpr std::array<double, 2> Sides{ -1.0, 1.0 }; // right, left

template <typename TSolid>
int
Add(Parts & parts, PhantomLabel label, int parent, TSolid solid)
{
  parts.push_back({ std::make_shared<const TSolid>(std::move(solid)), label, parent });
  return static_cast<int>(parts.size()) - 1;
}

/** The y of the middle of the vertebral bodies. */
double
SpineLine(double z)
{
  static const PhantomProfile line(
    { { 64, 20 }, { 110, 16 }, { 190, 32 }, { 300, 42 }, { 350, 40 }, { 393, 30 }, { 430, 24 }, { 505, 20 } });
  return line(z);
}

std::vector<PhantomRelief>
FaceReliefs()
{
  std::vector<PhantomRelief> reliefs{
    { true, 0, 543, 13, 31, 13, 1.5 }, // bridge of the nose
    { true, 0, 531, 17, 15, 15, 1.5 }, // its tip
    { true, 0, 508, 26, 7, 4, 1.5 },   // lips
    { true, 0, 497, 23, 7, 4, 1.5 },   { true, 0, 503, 28, 4, -3, 1.5 }, { true, 0, 477, 24, 14, 6, 1.5 }, // chin
  };
  for (const double side : Sides)
  {
    reliefs.push_back({ true, side * 31, 564, 22, 15, -11, 1.5 }); // eyes
    reliefs.push_back({ true, side * 31, 563, 13, 8, 6, 1.0 });
    reliefs.push_back({ true, side * 26, 582, 26, 9, 4, 1.5 });  // brow
    reliefs.push_back({ true, side * 38, 537, 24, 22, 6, 1.5 }); // cheek
  }
  return reliefs;
}

std::vector<PhantomRelief>
TrunkReliefs()
{
  std::vector<PhantomRelief> reliefs{
    { true, 0, 399, 20, 13, -5, 1.5 },   // notch above the breastbone
    { true, 0, 300, 22, 80, -4, 1.5 },   // line down the chest
    { true, 0, 140, 20, 95, -3, 1.5 },   // line down the belly
    { true, 0, 84, 9, 10, -7, 1.5 },     // navel
    { false, 0, 200, 26, 185, -3, 1.5 }, // line down the back
  };
  for (const double side : Sides)
  {
    reliefs.push_back({ true, side * 76, 308, 86, 52, 9, 1.2 });   // breast
    reliefs.push_back({ true, side * 76, 391, 66, 9, 5, 1.5 });    // collarbone
    reliefs.push_back({ false, side * 88, 325, 62, 76, 10, 1.5 }); // shoulder blade
    reliefs.push_back({ false, side * 60, 45, 58, 42, 8, 1.5 });   // buttock
    reliefs.push_back({ false, side * 42, 130, 34, 80, 5, 1.5 });  // muscles along the spine
  }
  return reliefs;
}

PhantomLoft
MakeSkin()
{
  PhantomLoft::Shape shape{
    0.0,
    0.0,
    0.0,
    700.0,
    24.0,
    72.0,
    { { { 0, 166 },   { 50, 160 },  { 110, 148 }, { 180, 156 }, { 250, 171 }, { 310, 188 }, { 350, 199 }, { 378, 195 },
        { 394, 176 }, { 406, 142 }, { 417, 104 }, { 430, 74 },  { 444, 60 },  { 458, 54 },  { 470, 52 },  { 482, 53 },
        { 495, 57 },  { 515, 64 },  { 540, 71 },  { 575, 76 },  { 615, 79 },  { 640, 79 } } },
    { { { 0, 104 },  { 60, 113 }, { 110, 111 }, { 160, 107 }, { 210, 109 }, { 260, 113 }, { 300, 112 }, { 340, 101 },
        { 375, 83 }, { 400, 63 }, { 420, 50 },  { 434, 46 },  { 447, 49 },  { 457, 62 },  { 465, 82 },  { 473, 92 },
        { 490, 92 }, { 510, 92 }, { 545, 93 },  { 580, 96 },  { 610, 96 },  { 640, 93 } } },
    { { { 0, 96 },
        { 50, 94 },
        { 105, 89 },
        { 160, 97 },
        { 230, 108 },
        { 300, 114 },
        { 345, 111 },
        { 385, 98 },
        { 415, 82 },
        { 445, 73 },
        { 475, 71 },
        { 505, 78 },
        { 550, 94 },
        { 595, 99 },
        { 640, 95 } } },
    { { { 0, 2.4 },
        { 110, 2.3 },
        { 250, 2.5 },
        { 350, 2.6 },
        { 400, 2.4 },
        { 435, 2.1 },
        { 480, 2.2 },
        { 560, 2.1 },
        { 640, 2.05 } } },
    FaceReliefs()
  };
  const auto trunk = TrunkReliefs();
  shape.reliefs.insert(shape.reliefs.end(), trunk.begin(), trunk.end());
  return PhantomLoft(shape);
}

void
AddMarker(Parts & parts, const LoftPointer & skin)
{
  constexpr double thickness = 6.0;
  const auto addStroke = [&](std::pair<double, double> rangeX, std::pair<double, double> rangeZ) {
    Add(parts, PhantomMarker, PhantomPart::None, PhantomPlate(skin, rangeX, rangeZ, thickness));
  };
  addStroke({ 64, 76 }, { 272, 340 });
  addStroke({ 76, 108 }, { 328, 340 });
  addStroke({ 76, 96 }, { 300, 312 });
}

void
AddEars(Parts & parts, const LoftPointer & skin)
{
  for (const double side : Sides)
  {
    Add(parts, PhantomSkin, PhantomPart::None, PhantomFlap(skin, { side > 0.0, 10, 546, 14, 28, 13, 0.4 }));
  }
}

void
AddBrainAndSkull(Parts & parts, int muscle)
{
  PhantomLoft::Shape skull{
    0.0,
    0.0,
    511,
    691,
    0.0,
    69,
    { { { 511, 28 }, { 525, 30 }, { 537, 34 }, { 549, 48 }, { 560, 55 }, { 580, 63 }, { 600, 68 }, { 622, 70 } } },
    { { { 511, 75 }, { 530, 76 }, { 550, 79 }, { 575, 87 }, { 590, 86 }, { 622, 86 } } },
    { { { 511, 4 }, { 526, 8 }, { 535, 30 }, { 550, 78 }, { 565, 87 }, { 590, 91 }, { 622, 89 } } },
    2.1,
    { { true, 0, 536, 11, 18, -28, 0.5 } }
  };
  for (const double side : Sides)
  {
    skull.reliefs.push_back({ true, side * 30, 563, 18, 16, -40, 0.6 });
    skull.reliefs.push_back({ true, side * 27, 584, 25, 8, 4, 1.5 });
    skull.reliefs.push_back({ true, side * 30, 549, 12, 7, 5, 1.0 });
  }
  const int bone = Add(parts, PhantomSkull, muscle, PhantomLoft(skull));
  Add(parts,
      PhantomBrain,
      bone,
      PhantomLoft({ 0.0,
                    2.0,
                    541,
                    684,
                    10,
                    62,
                    { { { 541, 26 }, { 560, 44 }, { 580, 55 }, { 600, 61 }, { 622, 63 } } },
                    { { { 541, 8 }, { 578, 12 }, { 588, 60 }, { 598, 74 }, { 622, 79 } } },
                    { { { 541, 30 }, { 553, 64 }, { 570, 77 }, { 590, 82 }, { 622, 80 } } },
                    2.0,
                    {} }));
  for (const double side : Sides)
  {
    Add(parts, PhantomAirway, bone, PhantomEllipsoid({ side * 17, -42, 528 }, { 4.5, 10, 9 }));
    Add(parts, PhantomEyes, muscle, PhantomEllipsoid({ side * 30, -60, 563 }, { 11, 11, 11 }));
    Add(parts,
        PhantomSkull,
        muscle,
        PhantomHoop(
          { 0, -5, 58, 60, false, side > 0 ? 0.88 : -1.45, side > 0 ? 1.45 : -0.88, 2.5, 4, 549 })); // cheekbone
  }
}

void
AddJawAndTeeth(Parts & parts, int muscle)
{
  Add(parts,
      PhantomSkull,
      muscle,
      PhantomHoop({ 0,
                    -20,
                    41,
                    58,
                    false,
                    -1.8,
                    1.8,
                    4.0,
                    9.5,
                    { { { -1.75, 527 },
                        { -1.5, 510 },
                        { -1.25, 490 },
                        { -0.9, 486 },
                        { 0.9, 486 },
                        { 1.25, 490 },
                        { 1.5, 510 },
                        { 1.75, 527 } } } }));
  constexpr int teeth = 12; // in each row
  constexpr double spread = 1.25;
  for (int i = 0; i < teeth; ++i)
  {
    const double angle = spread * (2.0 * i / (teeth - 1) - 1.0);
    const double x = 25 * std::sin(angle);
    const double y = -42 - 35 * std::cos(angle);
    for (const double z : { 499.2, 507.0 })
    {
      Add(parts, PhantomTeeth, muscle, PhantomEllipsoid({ x, y, z }, { 2.7, 2.7, 3.7 }));
    }
  }
}

/** The sizes, in millimetres, of the vertebrae of one part of the spine. */
struct VertebraShape
{
  double halfWidth;
  double halfDepth;
  double halfHeight;
  double arch;       ///< radius of the arch around the spinal canal
  double spinous;    ///< half the length of the process that points to the back
  double slope;      ///< how far it points down, in degrees
  double transverse; ///< half the length of the processes that point to the sides
};

void
AddVertebra(Parts & parts, int muscle, double z, const VertebraShape & shape)
{
  const double y = SpineLine(z);
  const double canal = y + shape.halfDepth + shape.arch;
  constexpr double archThickness = 3.0;
  constexpr double gap = 0.5;
  Add(parts,
      PhantomSpine,
      muscle,
      PhantomLoft({ 0.0,
                    y,
                    z - shape.halfHeight,
                    z + shape.halfHeight,
                    3,
                    3,
                    shape.halfWidth,
                    shape.halfDepth,
                    shape.halfDepth,
                    2.3,
                    {} }));
  Add(parts,
      PhantomSpine,
      muscle,
      PhantomHoop({ 0, canal, shape.arch, shape.arch, true, -2.3, 2.3, archThickness, 0.6 * shape.halfHeight, z }));
  const double reach = canal + shape.arch + archThickness + gap + shape.spinous;
  Add(parts,
      PhantomSpine,
      muscle,
      PhantomEllipsoid({ 0, reach, z - 3 }, { 2.8, shape.spinous, 0.7 * shape.halfHeight }, { -shape.slope, 0, 0 }));
  for (const double side : Sides)
  {
    const double x = side * (shape.arch + archThickness + gap + shape.transverse);
    Add(parts, PhantomSpine, muscle, PhantomEllipsoid({ x, canal + 1, z }, { shape.transverse, 3.2, 3.5 }));
  }
}

constexpr double
ThoracicHeight(int number)
{
  return 393.0 - 18.5 * (number - 1);
}

void
AddSpine(Parts & parts, int muscle)
{
  for (const double z : { 411.0, 426.0, 441.0, 456.0, 471.0, 486.0, 501.0 })
  {
    AddVertebra(parts, muscle, z, { 11, 7.5, 6.8, 9, 4, 15, 4 });
  }
  for (int number = 1; number <= 12; ++number)
  {
    AddVertebra(parts, muscle, ThoracicHeight(number), { 14.5, 11, 8.4, 11, 7.5, 25, 6 });
  }
  for (const double z : { 166.0, 141.0, 115.5, 90.0, 64.5 })
  {
    AddVertebra(parts, muscle, z, { 20, 14, 11.6, 11, 5, 5, 9 });
  }
}

/** A pair of ribs. The front and back of its ellipse are on the line y; heights are drops below its vertebra. */
struct RibShape
{
  double halfWidth;
  double front;
  double back;
  double drop;      ///< down to the lowest point
  double rise;      ///< from there up to the breastbone
  double lastAngle; ///< of floating ribs and those that join the one above; 0 for those that reach the breastbone
};

void
AddRibs(Parts & parts, int muscle)
{
  constexpr std::array<RibShape, 12> ribs{ { { 62, -50, 58, 24, 0, 0 },
                                             { 84, -65, 66, 38, 4, 0 },
                                             { 100, -75, 71, 48, 10, 0 },
                                             { 111, -82, 75, 54, 16, 0 },
                                             { 119, -87, 77, 58, 24, 0 },
                                             { 124, -90, 78, 62, 32, 0 },
                                             { 127, -92, 78, 64, 40, 0 },
                                             { 128, -92, 77, 62, 12, 2.62 },
                                             { 127, -90, 76, 56, 6, 2.45 },
                                             { 122, -87, 74, 50, 0, 2.2 },
                                             { 112, -84, 71, 38, 0, 1.6 },
                                             { 98, -80, 68, 24, 0, 1.1 } } };
  constexpr double besideVertebra = 30.0;
  constexpr double besideSternum = 21.0;
  constexpr double lowest = 2.4;
  for (int number = 1; number <= 12; ++number)
  {
    const RibShape & rib = ribs[static_cast<std::size_t>(number - 1)];
    const double z = ThoracicHeight(number);
    const double first = std::asin(besideVertebra / rib.halfWidth);
    const double last = rib.lastAngle > 0 ? rib.lastAngle : pi - std::asin(besideSternum / rib.halfWidth);
    for (const double side : Sides)
    {
      std::vector<PhantomProfile::Knot> height{ { 0.2, z },
                                                { 0.6, z - 0.06 * rib.drop },
                                                { 0.5 * pi, z - 0.56 * rib.drop },
                                                { lowest, z - rib.drop },
                                                { pi - 0.15, z - rib.drop + rib.rise } };
      if (side < 0)
      {
        std::reverse(height.begin(), height.end());
        for (auto & knot : height)
        {
          knot.place = -knot.place;
        }
      }
      Add(parts,
          PhantomRibs,
          muscle,
          PhantomHoop({ 0,
                        0.5 * (rib.front + rib.back),
                        rib.halfWidth,
                        0.5 * (rib.back - rib.front),
                        true,
                        std::min(side * first, side * last),
                        std::max(side * first, side * last),
                        3.4,
                        5.8,
                        height }));
    }
  }
  Add(parts, PhantomRibs, muscle, PhantomEllipsoid({ 0, -78, 308 }, { 15, 5, 76 }, { -12, 0, 0 })); // breastbone
}

void
AddShouldersAndPelvis(Parts & parts, int muscle)
{
  for (const double side : Sides)
  {
    const double inner = side * 0.15;
    const double outer = side * 1.2;
    Add(parts,
        PhantomShoulders,
        muscle,
        PhantomHoop(
          { 0, 30, 148, 90, false, std::min(inner, outer), std::max(inner, outer), 4.8, 4.8, 386 })); // collarbone
    Add(parts, PhantomShoulders, muscle, PhantomEllipsoid({ side * 163, 8, 358 }, { 21, 21, 23 }));
    Add(parts,
        PhantomShoulders,
        muscle,
        PhantomEllipsoid({ side * 94, 70, 326 }, { 36, 4, 54 }, { 0, side * 8, side * -26 }));
    Add(parts, PhantomShoulders, muscle, PhantomCapsule({ side * 70, 96, 346 }, { side * 150, 50, 376 }, 4.0));
    const double back = side * 0.42;
    const double front = side * 2.0;
    const double wing = side * 1.2;
    std::vector<PhantomProfile::Knot> height{ { back, 42 }, { wing, 50 }, { front, 42 } };
    if (side < 0)
    {
      std::reverse(height.begin(), height.end());
    }
    Add(parts,
        PhantomPelvis,
        muscle,
        PhantomHoop({ 0, -2, 98, 58, true, std::min(back, front), std::max(back, front), 4.5, 25, height }));
  }
  Add(parts, PhantomPelvis, muscle, PhantomEllipsoid({ 0, 46, 35 }, { 36, 11, 16 }));
}

void
AddChest(Parts & parts, int muscle)
{
  Add(parts,
      PhantomRightLung,
      muscle,
      PhantomLoft({ { { { 228, -71 }, { 280, -69 }, { 330, -55 }, { 355, -45 }, { 385, -35 } } },
                    -4.0,
                    226,
                    388,
                    28,
                    36,
                    { { { 228, 42 }, { 280, 41 }, { 330, 32 }, { 355, 23 }, { 385, 15 } } },
                    { { { 228, 54 }, { 280, 48 }, { 330, 32 }, { 355, 26 }, { 385, 20 } } },
                    { { { 228, 56 }, { 280, 56 }, { 330, 51 }, { 385, 36 } } },
                    2.0,
                    {} }));
  Add(parts,
      PhantomLeftLung,
      muscle,
      PhantomLoft({ { { { 228, 83 }, { 280, 81.5 }, { 330, 63 }, { 355, 48 }, { 385, 35 } } },
                    -2.0,
                    226,
                    388,
                    28,
                    36,
                    { { { 228, 27 }, { 280, 26 }, { 330, 22 }, { 355, 20 }, { 385, 15 } } },
                    { { { 228, 50 }, { 280, 45 }, { 330, 33 }, { 355, 26 }, { 385, 20 } } },
                    { { { 228, 52 }, { 280, 52 }, { 330, 50 }, { 385, 36 } } },
                    2.0,
                    {} }));
  Add(parts,
      PhantomAirway,
      muscle,
      PhantomLoft({ 0.0,
                    { { { 345, 10 }, { 390, 2 }, { 440, 2 }, { 507, 0 } } },
                    345,
                    507,
                    8,
                    8,
                    { { { 345, 8 }, { 450, 8 }, { 480, 10 } } },
                    7.0,
                    7.0,
                    2.0,
                    {} }));
  Add(parts,
      PhantomAorta,
      muscle,
      PhantomLoft({ 6.0,
                    { { { 70, -10 }, { 110, -12 }, { 190, 6 }, { 300, 17 }, { 345, 15 } } },
                    70,
                    336,
                    10,
                    10,
                    9.5,
                    9.5,
                    9.5,
                    2.0,
                    {} }));
  const PhantomPoint centre{ 17, -40, 282 };
  const PhantomPoint turns{ 0, 25, 0 };
  const int sac = Add(parts, PhantomFat, muscle, PhantomEllipsoid(centre, { 37, 37, 52 }, turns));
  Add(parts, PhantomHeart, sac, PhantomEllipsoid(centre, { 33, 33, 47 }, turns));
}

void
AddBelly(Parts & parts, int muscle)
{
  const int belly =
    Add(parts,
        PhantomFat,
        muscle,
        PhantomLoft({ 0.0,
                      -40.0,
                      22,
                      222,
                      16,
                      34,
                      { { { 22, 66 }, { 50, 76 }, { 100, 94 }, { 145, 103 }, { 180, 100 }, { 222, 96 } } },
                      { { { 22, 40 }, { 60, 50 }, { 110, 48 }, { 180, 41 }, { 222, 38 } } },
                      { { { 22, 12 }, { 110, 14 }, { 145, 16 }, { 175, 25 }, { 222, 28 } } },
                      2.1,
                      { { false, -56, 132, 39, 80, 66, 0.5 }, { false, 56, 132, 39, 80, 66, 0.5 } } }));
  Add(parts, PhantomLiver, belly, PhantomEllipsoid({ -43, -43, 177 }, { 46, 30, 33 }, { 0, 12, 0 }));
  Add(parts, PhantomSpleen, belly, PhantomEllipsoid({ 71, -9, 173 }, { 14, 22, 21 }));
  Add(parts, PhantomStomach, belly, PhantomEllipsoid({ 49, -54, 174 }, { 32, 20, 29 }, { 0, -20, 0 }));
  Add(parts, PhantomRightKidney, belly, PhantomEllipsoid({ -58, 9, 113 }, { 18, 15, 36 }));
  Add(parts, PhantomLeftKidney, belly, PhantomEllipsoid({ 58, 9, 116 }, { 18, 15, 36 }));
  Add(parts, PhantomBowel, belly, PhantomEllipsoid({ 0, -60, 82 }, { 76, 22, 36 }));
}

Parts
MakeParts()
{
  constexpr double skinThickness = 2.0;
  const PhantomProfile fatThickness({ { 0, 9 }, { 380, 8 }, { 430, 4 }, { 460, 2.5 }, { 700, 2.5 } });

  const auto skin = std::make_shared<const PhantomLoft>(MakeSkin());
  const auto fat = std::make_shared<const PhantomLoft>(skin->Inset(skinThickness));
  Parts parts{ { skin, PhantomSkin, PhantomPart::None }, { fat, PhantomFat, 0 } };
  const int muscle = Add(parts, PhantomMuscle, 1, fat->Inset(fatThickness));
  AddMarker(parts, skin);
  AddEars(parts, skin);
  AddBrainAndSkull(parts, muscle);
  AddJawAndTeeth(parts, muscle);
  AddSpine(parts, muscle);
  AddRibs(parts, muscle);
  AddShouldersAndPelvis(parts, muscle);
  AddChest(parts, muscle);
  AddBelly(parts, muscle);
  return parts;
}

} // namespace

const std::vector<PhantomPart> &
PhantomParts()
{
  static const Parts parts = MakeParts();
  return parts;
}

} // namespace rhombic
