#ifndef itkAbortForwarding_h
#define itkAbortForwarding_h

#include "itkCommand.h"
#include "itkProcessObject.h"

#include <map>

namespace itk
{

/** \class AbortForwarding
 * \brief While it lives, all that is upstream of an image stops soon after a filter downstream of it is aborted.
 *
 * For filters that update their input piece by piece: of an abort during their own GenerateData(), ITK tells nobody
 * upstream. Each process object upstream looks for it at its ProgressEvents, and then throws ProcessAborted, through
 * the update of the input, or ends without a word, as StreamingImageFilter does: so the caller has to look at the
 * filter after the update, and to throw the half-made data away. One that reports no progress is waited for.
 *
 * Thread safety: one thread at a time, that which updates the filter.
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
