#include "rhombicFailure.h"
#include "rhombicSurfaceRequest.h"
#include "rhombicWording.h"

#include <vtkNamedColors.h>
#include <vtkNew.h>

#include <charconv>

namespace rhombic
{
namespace
{

/** The six digits of `#rrggbb` or `#rgb`, of which the latter has every other one; empty for other texts. */
std::string
DigitsOf(const std::string & text)
{
  const std::string digits = text.substr(text.rfind('#', 0) == 0 ? 1 : text.size());
  if (digits.find_first_not_of("0123456789abcdefABCDEF") != std::string::npos)
  {
    return "";
  }
  if (digits.size() == 3)
  {
    return { digits[0], digits[0], digits[1], digits[1], digits[2], digits[2] };
  }
  return digits.size() == 6 ? digits : "";
}

} // namespace

Colour
ParseColour(const std::string & text)
{
  const vtkNew<vtkNamedColors> named;
  if (named->ColorExists(text))
  {
    Colour colour;
    named->GetColorRGB(text, colour.data());
    return colour;
  }
  const std::string digits = DigitsOf(text);
  if (digits.empty())
  {
    throw Failure(FailureKind::Usage,
                  DescribeUnknown("colour",
                                  text,
                                  Split(named->GetColorNames(), "\n"),
                                  "write it as #rrggbb, #rgb or by a name of CSS, for example #f1d691 or white"));
  }
  unsigned int value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value, 16);
  const auto component = [value](unsigned int shift) { return static_cast<double>(value >> shift & 0xff) / 255.0; };
  return { component(16), component(8), component(0) };
}

} // namespace rhombic
