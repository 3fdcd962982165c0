#include "rhombicPhantomAnatomy.h"

#include "itkMath.h"

#include <cmath>

// Lengths are in mm, angles of hoops in radians, turns of ellipsoids in degrees. The body stands on z = 0 and is 700
// tall: a head, a neck and a trunk down to the hips. Where a number looks arbitrary, it places one part clear of its
// neighbours; the tests name the parts that overlap after a change.

namespace rhombic
{
namespace
{

using itk::Math::pi;
using Parts = std::vector<PhantomPart>;

constexpr std::array<double, 2> Sides{ -1.0, 1.0 }; // right, left

int
Add(Parts & parts, PhantomLabel label, int parent, PhantomSolid solid)
{
  parts.push_back({ std::move(solid), label, parent });
  return static_cast<int>(parts.size()) - 1;
}

std::vector<PhantomRelief>
FaceReliefs()
{
  std::vector<PhantomRelief> reliefs{
    { 0, 543, 13, 31, 13, 1.5 }, // bridge of the nose
    { 0, 531, 17, 15, 15, 1.5 }, // tip of the nose
    { 0, 508, 26, 7, 4, 1.5 },   // upper lip
    { 0, 497, 23, 7, 4, 1.5 },   // lower lip
    { 0, 477, 24, 14, 6, 1.5 },  // chin
  };
  for (const double side : Sides)
  {
    reliefs.push_back({ side * 31, 564, 22, 15, -11, 1.5 }); // eye's hollow
    reliefs.push_back({ side * 31, 563, 13, 8, 6, 1.0 });    // eye
    reliefs.push_back({ side * 26, 582, 26, 9, 4, 1.5 });    // brow
    reliefs.push_back({ side * 38, 537, 24, 22, 6, 1.5 });   // cheek
  }
  return reliefs;
}

PhantomLoft
Skin()
{
  PhantomLoft skin;
  skin.top = 700;
  skin.bottomCap = 24;
  skin.topCap = 72;
  skin.width = { { 0, 166 },   { 50, 160 },  { 110, 148 }, { 180, 156 }, { 250, 171 }, { 310, 188 },
                 { 350, 199 }, { 378, 195 }, { 394, 176 }, { 406, 142 }, { 417, 104 }, { 430, 74 },
                 { 444, 60 },  { 458, 54 },  { 470, 52 },  { 482, 53 },  { 495, 57 },  { 515, 64 },
                 { 540, 71 },  { 575, 76 },  { 615, 79 },  { 640, 79 } };
  skin.front = { { 0, 104 },   { 60, 113 },  { 110, 111 }, { 160, 107 }, { 210, 109 }, { 260, 115 },
                 { 300, 118 }, { 340, 107 }, { 375, 86 },  { 400, 65 },  { 420, 50 },  { 434, 46 },
                 { 447, 49 },  { 457, 62 },  { 465, 82 },  { 473, 92 },  { 490, 92 },  { 510, 92 },
                 { 545, 93 },  { 580, 96 },  { 610, 96 },  { 640, 93 } };
  skin.back = { { 0, 98 },    { 50, 98 },   { 105, 91 },  { 160, 98 }, { 230, 111 },
                { 300, 120 }, { 345, 116 }, { 385, 100 }, { 415, 82 }, { 445, 73 },
                { 475, 71 },  { 505, 78 },  { 550, 94 },  { 595, 99 }, { 640, 95 } };
  skin.exponent = { { 0, 2.4 },   { 110, 2.3 }, { 250, 2.5 }, { 350, 2.6 }, { 400, 2.4 },
                    { 435, 2.1 }, { 480, 2.2 }, { 560, 2.1 }, { 640, 2.05 } };
  skin.reliefs = FaceReliefs();
  return skin;
}

/** The letter F on the left chest: three plates. */
void
AddMarker(Parts & parts, const PhantomLoft & skin)
{
  constexpr double thickness = 8.0;
  const auto addStroke = [&](std::pair<double, double> rangeX, std::pair<double, double> rangeZ) {
    Add(parts, PhantomMarker, PhantomPart::None, MakePlate(skin, rangeX, rangeZ, thickness));
  };
  addStroke({ 64, 76 }, { 272, 340 });
  addStroke({ 76, 108 }, { 328, 340 });
  addStroke({ 76, 96 }, { 300, 312 });
}

void
AddEars(Parts & parts)
{
  for (const double side : Sides)
  {
    Add(parts,
        PhantomSkin,
        PhantomPart::None,
        MakeEllipsoid({ side * 78.1, 12, 546 }, { 5, 13, 25 }, { 0, side * 10, side * -16 }));
  }
}

void
AddBrainAndSkull(Parts & parts, int muscle)
{
  PhantomLoft skull;
  skull.bottom = 511;
  skull.top = 691;
  skull.topCap = 69;
  skull.width = {
    { 511, 28 }, { 525, 30 }, { 537, 34 }, { 549, 48 }, { 560, 55 }, { 580, 63 }, { 600, 68 }, { 622, 70 }
  };
  skull.front = { { 511, 75 }, { 530, 76 }, { 550, 79 }, { 575, 87 }, { 590, 86 }, { 622, 86 } };
  skull.back = { { 511, 4 }, { 526, 8 }, { 535, 30 }, { 550, 78 }, { 565, 87 }, { 590, 91 }, { 622, 89 } };
  skull.exponent = 2.1;
  skull.reliefs = { { 0, 536, 11, 18, -28, 0.5 } }; // nasal opening
  for (const double side : Sides)
  {
    skull.reliefs.push_back({ side * 30, 563, 18, 16, -40, 0.6 }); // orbit
    skull.reliefs.push_back({ side * 27, 584, 25, 8, 4, 1.5 });    // brow
    skull.reliefs.push_back({ side * 30, 549, 12, 7, 5, 1.0 });    // cheek
  }
  const int bone = Add(parts, PhantomSkull, muscle, MakeLoft(skull));

  PhantomLoft brain;
  brain.centreY = 2.0;
  brain.bottom = 541;
  brain.top = 684;
  brain.bottomCap = 10;
  brain.topCap = 62;
  brain.width = { { 541, 26 }, { 560, 44 }, { 580, 55 }, { 600, 61 }, { 622, 63 } };
  brain.front = { { 541, 8 }, { 578, 12 }, { 588, 60 }, { 598, 74 }, { 622, 79 } };
  brain.back = { { 541, 30 }, { 553, 64 }, { 570, 77 }, { 590, 82 }, { 622, 80 } };
  Add(parts, PhantomBrain, bone, MakeLoft(brain));

  for (const double side : Sides)
  {
    Add(parts, PhantomAirway, bone, MakeEllipsoid({ side * 17, -42, 528 }, { 4.5, 10, 9 })); // sinus
    Add(parts, PhantomEyes, muscle, MakeEllipsoid({ side * 30, -60, 563 }, { 11, 11, 11 }));
    Add(parts, PhantomSkull, muscle, MakeHoop({ -5, side * 58, -60, 0.88, 1.45, 2.5, 4, 549 })); // cheekbone
  }
}

void
AddJawAndTeeth(Parts & parts, int muscle)
{
  const PhantomProfile height{ { -1.75, 527 }, { -1.5, 510 }, { -1.25, 490 }, { -0.9, 486 },
                               { 0.9, 486 },   { 1.25, 490 }, { 1.5, 510 },   { 1.75, 527 } };
  Add(parts, PhantomSkull, muscle, MakeHoop({ -20, 41, -58, -1.8, 1.8, 4.0, 9.5, height }));
  constexpr int teeth = 12; // in each row
  constexpr double spread = 1.25;
  for (int i = 0; i < teeth; ++i)
  {
    const double angle = spread * (2.0 * i / (teeth - 1) - 1.0);
    const double x = 25 * std::sin(angle);
    const double y = -42 - 35 * std::cos(angle);
    for (const double z : { 499.2, 507.0 })
    {
      Add(parts, PhantomTeeth, muscle, MakeEllipsoid({ x, y, z }, { 2.7, 2.7, 3.7 }));
    }
  }
}

/** The sizes of the vertebrae of one part of the spine. */
struct Vertebra
{
  double halfWidth;
  double halfDepth;
  double halfHeight;
  double arch;       ///< radius of the arch around the spinal canal
  double spinous;    ///< half the length of the process that points to the back
  double slope;      ///< how far it points down, in degrees
  double transverse; ///< half the length of the processes that point to the sides
};

/** The y of the middle of the vertebral bodies. */
double
SpineAt(double z)
{
  static const PhantomProfile line{ { 64, 20 },  { 110, 16 }, { 190, 32 }, { 300, 42 },
                                    { 350, 40 }, { 393, 30 }, { 430, 24 }, { 505, 20 } };
  return line(z);
}

void
AddVertebra(Parts & parts, int muscle, double z, const Vertebra & vertebra)
{
  constexpr double archThickness = 3.3;
  constexpr double gap = 0.5;
  const auto add = [&](PhantomSolid solid) { Add(parts, PhantomSpine, muscle, std::move(solid)); };
  PhantomLoft body;
  body.centreY = SpineAt(z);
  body.bottom = z - vertebra.halfHeight;
  body.top = z + vertebra.halfHeight;
  body.bottomCap = body.topCap = 3.0;
  body.width = vertebra.halfWidth;
  body.front = body.back = vertebra.halfDepth;
  body.exponent = 2.3;
  add(MakeLoft(body));
  const double canal = SpineAt(z) + vertebra.halfDepth + vertebra.arch;
  add(MakeHoop({ canal, vertebra.arch, vertebra.arch, -2.6, 2.6, archThickness, 0.6 * vertebra.halfHeight, z }));
  add(MakeEllipsoid({ 0, canal + vertebra.arch + archThickness + gap + vertebra.spinous, z - 3 },
                    { 2.8, vertebra.spinous, 0.7 * vertebra.halfHeight },
                    { -vertebra.slope, 0, 0 }));
  for (const double side : Sides)
  {
    const double x = side * (vertebra.arch + archThickness + gap + vertebra.transverse);
    add(MakeEllipsoid({ x, canal + 1, z }, { vertebra.transverse, 3.2, 3.5 }));
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
struct Rib
{
  double halfWidth;
  double front;
  double back;
  double drop;      ///< down to the lowest point
  double rise;      ///< from there up to the breastbone
  double lastAngle; ///< where floating ribs, and those that join the rib above, end; 0 for ribs up to the breastbone
};

void
AddRibs(Parts & parts, int muscle)
{
  constexpr std::array<Rib, 12> ribs{ { { 62, -50, 58, 24, 0, 0 },
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
  for (int number = 1; number <= 12; ++number)
  {
    const Rib & rib = ribs[static_cast<std::size_t>(number - 1)];
    const double z = ThoracicHeight(number);
    const double first = std::asin(besideVertebra / rib.halfWidth);
    const double last = rib.lastAngle > 0 ? rib.lastAngle : pi - std::asin(besideSternum / rib.halfWidth);
    const PhantomProfile height{ { 0.2, z },
                                 { 0.6, z - 0.06 * rib.drop },
                                 { 0.5 * pi, z - 0.56 * rib.drop },
                                 { 2.4, z - rib.drop },
                                 { pi - 0.15, z - rib.drop + rib.rise } };
    const double centreY = 0.5 * (rib.front + rib.back);
    const double radiusY = 0.5 * (rib.back - rib.front);
    for (const double side : Sides)
    {
      Add(parts,
          PhantomRibs,
          muscle,
          MakeHoop({ centreY, side * rib.halfWidth, radiusY, first, last, 3.4, 5.8, height }));
    }
  }
  Add(parts, PhantomRibs, muscle, MakeEllipsoid({ 0, -78, 308 }, { 15, 5, 76 }, { -12, 0, 0 })); // breastbone
}

void
AddShoulders(Parts & parts, int muscle)
{
  const auto add = [&](PhantomSolid solid) { Add(parts, PhantomShoulders, muscle, std::move(solid)); };
  for (const double side : Sides)
  {
    add(MakeHoop({ 30, side * 148, -90, 0.15, 1.2, 4.8, 4.8, 384 }));                           // collarbone
    add(MakeEllipsoid({ side * 163, 8, 358 }, { 21, 21, 23 }));                                 // head of the humerus
    add(MakeEllipsoid({ side * 94, 70, 325 }, { 36, 4.5, 54 }, { 0, side * 8, side * -26 }));   // shoulder blade
    add(MakeEllipsoid({ side * 110, 73, 361 }, { 46, 5, 5.5 }, { 0, side * -18, side * -30 })); // its spine
  }
}

void
AddPelvis(Parts & parts, int muscle)
{
  const PhantomProfile height{ { 0.42, 42 }, { 1.2, 50 }, { 2.0, 42 } };
  for (const double side : Sides)
  {
    Add(parts, PhantomPelvis, muscle, MakeHoop({ -2, side * 98, 58, 0.42, 2.0, 4.5, 25, height })); // iliac wing
  }
  Add(parts, PhantomPelvis, muscle, MakeEllipsoid({ 0, 46, 35 }, { 36, 11, 16 })); // sacrum
}

void
AddLungsAndAirway(Parts & parts, int muscle)
{
  PhantomLoft right;
  right.centreX = { { 228, -71 }, { 280, -69 }, { 330, -55 }, { 355, -45 }, { 385, -35 } };
  right.centreY = -4.0;
  right.bottom = 226;
  right.top = 388;
  right.bottomCap = 28;
  right.topCap = 36;
  right.width = { { 228, 42 }, { 280, 41 }, { 330, 32 }, { 355, 23 }, { 385, 15 } };
  right.front = { { 228, 54 }, { 280, 48 }, { 330, 32 }, { 355, 26 }, { 385, 20 } };
  right.back = { { 228, 56 }, { 280, 56 }, { 330, 51 }, { 385, 36 } };
  Add(parts, PhantomRightLung, muscle, MakeLoft(right));

  PhantomLoft left = right;
  left.centreX = { { 228, 83 }, { 280, 81.5 }, { 330, 63 }, { 355, 48 }, { 385, 35 } };
  left.centreY = -2.0;
  left.width = { { 228, 27 }, { 280, 26 }, { 330, 22 }, { 355, 20 }, { 385, 15 } };
  left.front = { { 228, 50 }, { 280, 45 }, { 330, 33 }, { 355, 26 }, { 385, 20 } };
  left.back = { { 228, 52 }, { 280, 52 }, { 330, 50 }, { 385, 36 } };
  Add(parts, PhantomLeftLung, muscle, MakeLoft(left));

  PhantomLoft windpipe;
  windpipe.centreY = { { 345, 10 }, { 390, 2 }, { 440, 2 }, { 507, 0 } };
  windpipe.bottom = 345;
  windpipe.top = 507;
  windpipe.bottomCap = windpipe.topCap = 8;
  windpipe.width = { { 345, 8 }, { 450, 8 }, { 480, 10 } };
  windpipe.front = windpipe.back = 7.0;
  Add(parts, PhantomAirway, muscle, MakeLoft(windpipe));
}

void
AddHeartAndAorta(Parts & parts, int muscle)
{
  const PhantomPoint centre{ 17, -40, 282 };
  const PhantomPoint turns{ 0, 25, 0 };
  const int sac = Add(parts, PhantomFat, muscle, MakeEllipsoid(centre, { 37, 37, 52 }, turns));
  Add(parts, PhantomHeart, sac, MakeEllipsoid(centre, { 33, 33, 47 }, turns));

  PhantomLoft aorta;
  aorta.centreX = 6.0;
  aorta.centreY = { { 70, -10 }, { 110, -12 }, { 190, 6 }, { 300, 17 }, { 345, 15 } };
  aorta.bottom = 70;
  aorta.top = 336;
  aorta.bottomCap = aorta.topCap = 10;
  aorta.width = aorta.front = aorta.back = 9.5;
  Add(parts, PhantomAorta, muscle, MakeLoft(aorta));
}

/** The organs of the abdomen. The cavity, and the beds of spleen and kidneys, are fat. */
void
AddAbdomen(Parts & parts, int muscle)
{
  PhantomLoft fat;
  fat.centreY = -40.0;
  fat.bottom = 22;
  fat.top = 222;
  fat.bottomCap = 16;
  fat.topCap = 34;
  fat.width = { { 22, 66 }, { 50, 76 }, { 100, 94 }, { 145, 103 }, { 180, 100 }, { 222, 96 } };
  fat.front = { { 22, 40 }, { 60, 50 }, { 110, 48 }, { 180, 41 }, { 222, 38 } };
  fat.back = { { 22, 12 }, { 110, 14 }, { 145, 22 }, { 175, 33 }, { 222, 36 } };
  fat.exponent = 2.1;
  const int cavity = Add(parts, PhantomFat, muscle, MakeLoft(fat));
  Add(parts, PhantomLiver, cavity, MakeEllipsoid({ -43, -45, 178 }, { 46, 30, 33 }, { 0, 12, 0 }));
  Add(parts, PhantomStomach, cavity, MakeEllipsoid({ 49, -54, 174 }, { 32, 20, 29 }, { 0, -20, 0 }));
  Add(parts, PhantomBowel, cavity, MakeEllipsoid({ 0, -60, 82 }, { 76, 22, 36 }));

  const auto addInBed = [&](PhantomLabel label, const PhantomPoint & centre, const PhantomPoint & halfAxes) {
    constexpr double margin = 4.0;
    const int bed = Add(parts,
                        PhantomFat,
                        muscle,
                        MakeEllipsoid(centre, { halfAxes[0] + margin, halfAxes[1] + margin, halfAxes[2] + margin }));
    Add(parts, label, bed, MakeEllipsoid(centre, halfAxes));
  };
  addInBed(PhantomSpleen, { 86, 3.5, 178 }, { 12, 19, 23 });
  addInBed(PhantomRightKidney, { -58, 10, 113 }, { 18, 15, 36 });
  addInBed(PhantomLeftKidney, { 58, 10, 116 }, { 18, 15, 36 });
}

Parts
MakeParts()
{
  constexpr double skinThickness = 2.0;
  const PhantomProfile fatThickness{ { 0, 9 }, { 380, 8 }, { 430, 4 }, { 460, 2.5 }, { 700, 2.5 } };

  Parts parts;
  const PhantomLoft skin = Skin();
  const PhantomLoft fat = InsetOf(skin, skinThickness);
  const int body = Add(parts, PhantomSkin, PhantomPart::None, MakeLoft(skin));
  const int inSkin = Add(parts, PhantomFat, body, MakeLoft(fat));
  const int muscle = Add(parts, PhantomMuscle, inSkin, MakeLoft(InsetOf(fat, fatThickness)));
  AddMarker(parts, skin);
  AddEars(parts);
  AddBrainAndSkull(parts, muscle);
  AddJawAndTeeth(parts, muscle);
  AddSpine(parts, muscle);
  AddRibs(parts, muscle);
  AddShoulders(parts, muscle);
  AddPelvis(parts, muscle);
  AddLungsAndAirway(parts, muscle);
  AddHeartAndAorta(parts, muscle);
  AddAbdomen(parts, muscle);
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
