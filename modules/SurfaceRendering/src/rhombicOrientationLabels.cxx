#include "rhombicOrientationLabels.h"

#include <vtkNew.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <cmath>

namespace rhombic
{
namespace
{

constexpr double LetterShare = 0.03;    // size, relative to the picture's shorter side
constexpr double SmallestLetter = 12.0; // pixels

double
LetterSize(const RenderSettings & settings)
{
  return std::max(LetterShare * std::min(settings.width, settings.height), SmallestLetter);
}

/** Relative luminance, 0 to 1, of an sRGB colour (ITU-R BT.709). */
double
Luminance(const Colour & colour)
{
  return 0.2126 * std::pow(colour[0], 2.2) + 0.7152 * std::pow(colour[1], 2.2) + 0.0722 * std::pow(colour[2], 2.2);
}

/** Nearly black or nearly white, whichever has more contrast. At a luminance of 0.179 black and white have the same
 * contrast (the formula of the Web Content Accessibility Guidelines). */
double
LetterBrightness(const Colour & background)
{
  return Luminance(background) < 0.179 ? 0.9 : 0.1;
}

/** \a x and \a y are shares of the picture's width and height, from the bottom left. */
void
AddLetter(char letter, double x, double y, const RenderSettings & settings, vtkRenderer * renderer)
{
  vtkNew<vtkTextActor> actor;
  const char text[] = { letter, '\0' };
  actor->SetInput(text);
  actor->SetPosition(x * settings.width * settings.samples, y * settings.height * settings.samples);
  vtkTextProperty * const property = actor->GetTextProperty();
  const double brightness = LetterBrightness(settings.background);
  property->SetColor(brightness, brightness, brightness);
  property->SetFontFamilyToArial();
  property->BoldOn();
  property->SetFontSize(static_cast<int>(std::lround(LetterSize(settings) * settings.samples)));
  property->SetJustificationToCentered();
  property->SetVerticalJustificationToCentered();
  renderer->AddActor2D(actor);
}

} // namespace

double
OrientationLabelMargin(const RenderSettings & settings)
{
  return 1.5 * LetterSize(settings);
}

void
AddOrientationLabels(const RenderSettings & settings, vtkRenderer * renderer)
{
  const EdgeLetters letters = EdgeLettersOf(settings.view);
  const double x = 0.5 * OrientationLabelMargin(settings) / settings.width;
  const double y = 0.5 * OrientationLabelMargin(settings) / settings.height;
  AddLetter(letters.left, x, 0.5, settings, renderer);
  AddLetter(letters.right, 1.0 - x, 0.5, settings, renderer);
  AddLetter(letters.bottom, 0.5, y, settings, renderer);
  AddLetter(letters.top, 0.5, 1.0 - y, settings, renderer);
}

} // namespace rhombic
