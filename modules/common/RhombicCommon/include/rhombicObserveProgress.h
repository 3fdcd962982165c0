#ifndef rhombicObserveProgress_h
#define rhombicObserveProgress_h

#include "rhombicEvents.h"

#include "itkProcessObject.h"

namespace rhombic
{

/** Reports a filter's progress to Events::progress as that of \a step. \a events must outlive the filter's work. Thread
 * safety: that of itk::Object::AddObserver(). */
void
ObserveProgress(itk::ProcessObject & filter, const std::string & step, const Events & events);

} // namespace rhombic

#endif
