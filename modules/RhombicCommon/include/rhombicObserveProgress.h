#ifndef rhombicObserveProgress_h
#define rhombicObserveProgress_h

#include "rhombicEvents.h"

#include "itkProcessObject.h"

namespace rhombic
{

/** Passes a filter's progress on as that of one step. \a events must outlive the filter's work. */
void
ObserveProgress(itk::ProcessObject & filter, const std::string & step, const Events & events);

} // namespace rhombic

#endif
