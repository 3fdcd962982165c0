#ifndef itkAbortForwarding_h
#define itkAbortForwarding_h

#include "itkCommand.h"
#include "itkProcessObject.h"

#include <map>

namespace itk
{

/** \class AbortForwarding
 * \brief As long as it exists, an abort of a filter also aborts the process objects upstream of its input.
 *
 * For filters that update their input piece by piece in GenerateData(), where ITK does not pass an abort upstream. Each
 * upstream process object checks the filter's AbortGenerateData at its own ProgressEvents. It then throws
 * ProcessAborted through the input's Update(), or ends without an exception, as StreamingImageFilter does: the caller
 * has to check AbortGenerateData after the update and discard the incomplete data. A process object that reports no
 * progress runs to its end.
 *
 * Thread safety: for the thread that updates the filter.
 */
class AbortForwarding
{
public:
  AbortForwarding(const ProcessObject & filter, const DataObject & input)
    : m_Filter(filter)
  {
    this->Observe(input);
  }

  AbortForwarding(const AbortForwarding &) = delete;
  AbortForwarding &
  operator=(const AbortForwarding &) = delete;

  ~AbortForwarding()
  {
    for (const auto & [source, observer] : m_Observers)
    {
      source->RemoveObserver(observer);
    }
  }

private:
  void
  Observe(const DataObject & data)
  {
    const ProcessObject::Pointer source = data.GetSource().GetPointer();
    if (source == nullptr || m_Observers.count(source) > 0)
    {
      return;
    }
    m_Observers[source] =
      source->AddObserver(ProgressEvent(), [this, source = source.GetPointer()](const EventObject &) {
        if (m_Filter.GetAbortGenerateData() && !source->GetAbortGenerateData())
        {
          source->AbortGenerateDataOn();
        }
      });
    for (const auto & input : source->GetInputs())
    {
      if (input != nullptr)
      {
        this->Observe(*input);
      }
    }
  }

  const ProcessObject & m_Filter;
  std::map<ProcessObject::Pointer, unsigned long> m_Observers;
};

} // namespace itk

#endif
