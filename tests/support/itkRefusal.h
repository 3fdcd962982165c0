#ifndef itkRefusal_h
#define itkRefusal_h

#include "itkMacro.h"

#include <string>

/** The sentence of the exception that \a work throws; empty when there is none. */
template <typename TWork>
std::string
Refusal(const TWork & work)
{
  try
  {
    work();
  }
  catch (const itk::ExceptionObject & failure)
  {
    return failure.GetDescription();
  }
  return {};
}

#endif
