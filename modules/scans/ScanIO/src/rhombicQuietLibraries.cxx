#include "rhombicQuietLibraries.h"

#include "itkObject.h"

#include <gdcmTrace.h>

#include <mutex>

namespace rhombic
{
namespace
{

struct Switches
{
  bool itkWarnings;
  bool gdcmDebug;
  bool gdcmWarnings;
  bool gdcmErrors;
};

std::mutex guard;
int users = 0;
Switches before;

void
Set(const Switches & switches)
{
  itk::Object::SetGlobalWarningDisplay(switches.itkWarnings);
  gdcm::Trace::SetDebug(switches.gdcmDebug);
  gdcm::Trace::SetWarning(switches.gdcmWarnings);
  gdcm::Trace::SetError(switches.gdcmErrors);
}

} // namespace

QuietLibraries::QuietLibraries()
{
  const std::lock_guard<std::mutex> lock(guard);
  if (users++ == 0)
  {
    before = { itk::Object::GetGlobalWarningDisplay(),
               gdcm::Trace::GetDebugFlag(),
               gdcm::Trace::GetWarningFlag(),
               gdcm::Trace::GetErrorFlag() };
    Set({ false, false, false, false });
  }
}

QuietLibraries::~QuietLibraries()
{
  const std::lock_guard<std::mutex> lock(guard);
  if (--users == 0)
  {
    Set(before);
  }
}

} // namespace rhombic
