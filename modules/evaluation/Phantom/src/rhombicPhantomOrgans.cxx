#include "rhombicPhantom.h"

#include "rhombicFailure.h"
#include "rhombicPhantomAnatomy.h"
#include "rhombicWording.h"

#include <algorithm>

namespace rhombic
{
namespace
{

constexpr double AirHounsfield = -1000.0;

/** The organs. The volume of each solid counts for its organ, and not for the organ around the solid. */
std::vector<PhantomOrgan>
MakeOrgans()
{
  std::vector<PhantomOrgan> organs{
    { "skin", PhantomSkin, 30, 0, { 0.89f, 0.71f, 0.59f } },
    { "fat", PhantomFat, -100, 0, { 0.94f, 0.85f, 0.52f } },
    { "muscle", PhantomMuscle, 50, 0, { 0.69f, 0.30f, 0.26f } },
    { "skull", PhantomSkull, 900, 0, { 0.95f, 0.90f, 0.76f } },
    { "teeth", PhantomTeeth, 1600, 0, { 1.00f, 0.98f, 0.92f } },
    { "spine", PhantomSpine, 600, 0, { 0.93f, 0.85f, 0.65f } },
    { "ribs", PhantomRibs, 700, 0, { 0.95f, 0.84f, 0.57f } },
    { "shoulders", PhantomShoulders, 750, 0, { 0.91f, 0.80f, 0.60f } },
    { "pelvis", PhantomPelvis, 700, 0, { 0.90f, 0.78f, 0.55f } },
    { "brain", PhantomBrain, 35, 0, { 0.86f, 0.66f, 0.64f } },
    { "eyes", PhantomEyes, 10, 0, { 0.80f, 0.87f, 0.92f } },
    { "airway", PhantomAirway, -1000, 0, { 0.55f, 0.80f, 0.92f } },
    { "right lung", PhantomRightLung, -850, 0, { 0.80f, 0.55f, 0.58f } },
    { "left lung", PhantomLeftLung, -850, 0, { 0.84f, 0.61f, 0.64f } },
    { "heart", PhantomHeart, 45, 0, { 0.79f, 0.20f, 0.20f } },
    { "aorta", PhantomAorta, 42, 0, { 0.88f, 0.13f, 0.13f } },
    { "liver", PhantomLiver, 60, 0, { 0.60f, 0.28f, 0.21f } },
    { "spleen", PhantomSpleen, 52, 0, { 0.52f, 0.25f, 0.42f } },
    { "stomach", PhantomStomach, 20, 0, { 0.87f, 0.58f, 0.46f } },
    { "right kidney", PhantomRightKidney, 32, 0, { 0.73f, 0.40f, 0.18f } },
    { "left kidney", PhantomLeftKidney, 32, 0, { 0.78f, 0.46f, 0.23f } },
    { "bowel", PhantomBowel, 15, 0, { 0.82f, 0.68f, 0.50f } },
    { "marker", PhantomMarker, 2000, 0, { 0.30f, 0.62f, 0.35f } },
  };
  const auto volumeOf = [&organs](int label) -> double & { return organs[static_cast<std::size_t>(label) - 1].volume; };
  const auto & parts = PhantomParts();
  for (const auto & part : parts)
  {
    volumeOf(part.label) += part.solid.volume;
    if (part.parent != PhantomPart::None)
    {
      volumeOf(parts[static_cast<std::size_t>(part.parent)].label) -= part.solid.volume;
    }
  }
  return organs;
}

} // namespace

const std::vector<PhantomOrgan> &
PhantomOrgans()
{
  static const std::vector<PhantomOrgan> organs = MakeOrgans();
  return organs;
}

double
HounsfieldOf(int label)
{
  return label == PhantomAir ? AirHounsfield : PhantomOrgans()[static_cast<std::size_t>(label) - 1].hounsfield;
}

int
PhantomLabelAt(const PhantomPoint & point)
{
  const auto & parts = PhantomParts();
  const auto part =
    std::find_if(parts.rbegin(), parts.rend(), [&point](const auto & p) { return p.solid.Contains(point); });
  return part == parts.rend() ? PhantomAir : part->label;
}

PhantomEnclosure
PhantomEnclosedBy(double threshold)
{
  if (!(threshold > AirHounsfield))
  {
    throw Failure(FailureKind::Usage,
                  "A threshold of " + FormatNumber(threshold) +
                    " HU encloses the endless air around the phantom; give one above -1000 HU.");
  }
  PhantomEnclosure enclosure{ {}, 0.0 };
  for (const auto & organ : PhantomOrgans())
  {
    if (organ.hounsfield >= threshold)
    {
      enclosure.labels.push_back(organ.label);
      enclosure.volume += organ.volume;
    }
  }
  return enclosure;
}

} // namespace rhombic
