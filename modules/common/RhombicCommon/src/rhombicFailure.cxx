#include "rhombicFailure.h"

#include <algorithm>

namespace rhombic
{

Failure::Failure(FailureKind kind,
                 const std::string & description,
                 const char * file,
                 unsigned int line,
                 const char * location)
  : itk::ExceptionObject(file, line, description, location)
  , m_Kind(kind)
{}

std::string
DescribeError(const std::exception & error)
{
  const auto * const fromITK = dynamic_cast<const itk::ExceptionObject *>(&error);
  std::string text = fromITK != nullptr ? fromITK->GetDescription() : error.what();
  const auto end = text.find("): ");
  if ((text.rfind("ITK ", 0) == 0 || text.rfind("itk::", 0) == 0) && end != std::string::npos)
  {
    text.erase(0, end + 3);
  }
  text.erase(std::min(text.find('\n'), text.size()));
  text.erase(text.find_last_not_of(" .:") + 1);
  return text;
}

} // namespace rhombic
