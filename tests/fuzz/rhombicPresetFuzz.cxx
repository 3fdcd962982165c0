#include "rhombicFailure.h"
#include "rhombicFuzzProperty.h"
#include "rhombicPresets.h"

#include <cmath>

using rhombicfuzz::Require;

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  try
  {
    const auto preset = rhombic::ParsePreset(std::string(reinterpret_cast<const char *>(data), size), "fuzz.yaml");
    Require(!preset.surfaces.empty(), "a preset has surfaces");
    for (const rhombic::SurfaceRequest & surface : preset.surfaces)
    {
      Require(std::isfinite(surface.isovalue.value_or(0)), "isovalues are finite");
      Require(surface.opacity > 0 && surface.opacity <= 1, "the opacity is above 0 and at most 1");
    }
  }
  catch (const rhombic::Failure & failure)
  {
    Require(failure.GetKind() == rhombic::FailureKind::Unreadable, "a bad preset is unreadable");
  }
  return 0;
}
