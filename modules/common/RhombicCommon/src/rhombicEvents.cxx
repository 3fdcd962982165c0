#include "rhombicEvents.h"

#include "itkProcessObject.h"

namespace rhombic
{

void
ObserveProgress(itk::ProcessObject & filter, const std::string & step, const Events & events)
{
  filter.AddObserver(itk::ProgressEvent(), [&filter, step, &events](const itk::EventObject &) {
    events.Progress(step, static_cast<double>(filter.GetProgress()));
  });
}

} // namespace rhombic
