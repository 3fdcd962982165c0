#include "rhombicFailure.h"

namespace rhombic
{

Failure::Failure(FailureKind kind, const std::string & description)
  : itk::ExceptionObject("Rhombic", 0, description)
  , m_Kind(kind)
{}

} // namespace rhombic
