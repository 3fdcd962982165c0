#ifndef itkRecordingMultiThreader_h
#define itkRecordingMultiThreader_h

#include "itkObjectFactoryBase.h"
#include "itkPlatformMultiThreader.h"
#include "itkPoolMultiThreader.h"
#include "itkVersion.h"

#include <algorithm>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <typeinfo>
#include <vector>

namespace filtertest
{

/** Of the thread pool's synchronisation, which is in ITK's library, the thread sanitizer sees nothing. */
#ifdef __SANITIZE_THREAD__
using SeenMultiThreader = itk::PlatformMultiThreader;
#else
using SeenMultiThreader = itk::PoolMultiThreader;
#endif

/** A host application's threader: it sees which threads a filter works on, and in how many units. */
class RecordingMultiThreader : public SeenMultiThreader
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(RecordingMultiThreader);

  using Self = RecordingMultiThreader;
  using Superclass = SeenMultiThreader;
  using Pointer = itk::SmartPointer<Self>;

  itkFactorylessNewMacro(Self);
  itkTypeMacro(RecordingMultiThreader, SeenMultiThreader);

  void
  ParallelizeArray(itk::SizeValueType first,
                   itk::SizeValueType end,
                   ArrayThreadingFunctorType work,
                   itk::ProcessObject * filter) override
  {
    m_MostWorkUnits = std::max(m_MostWorkUnits, this->GetNumberOfWorkUnits());
    Superclass::ParallelizeArray(
      first,
      end,
      [&](itk::SizeValueType n) {
        const Visit visit(*this);
        work(n);
      },
      filter);
  }

  void
  ParallelizeImageRegion(unsigned int dimension,
                         const itk::IndexValueType index[],
                         const itk::SizeValueType size[],
                         ThreadingFunctorType work,
                         itk::ProcessObject * filter) override
  {
    m_MostWorkUnits = std::max(m_MostWorkUnits, this->GetNumberOfWorkUnits());
    Superclass::ParallelizeImageRegion(
      dimension,
      index,
      size,
      [&](const itk::IndexValueType * partIndex, const itk::SizeValueType * partSize) {
        const Visit visit(*this);
        work(partIndex, partSize);
      },
      filter);
  }

  itk::ThreadIdType
  GetMostWorkUnits() const
  {
    return m_MostWorkUnits;
  }
  std::size_t
  GetMostAtOnce() const
  {
    return m_MostAtOnce;
  }
  const std::set<std::thread::id> &
  GetThreads() const
  {
    return m_Threads;
  }

protected:
  RecordingMultiThreader() = default;
  ~RecordingMultiThreader() override = default;

private:
  class Visit
  {
  public:
    explicit Visit(RecordingMultiThreader & threader)
      : m_Threader(threader)
    {
      const std::lock_guard<std::mutex> lock(m_Threader.m_Mutex);
      m_Threader.m_Threads.insert(std::this_thread::get_id());
      m_Threader.m_MostAtOnce = std::max(m_Threader.m_MostAtOnce, ++m_Threader.m_AtOnce);
    }
    ~Visit()
    {
      const std::lock_guard<std::mutex> lock(m_Threader.m_Mutex);
      --m_Threader.m_AtOnce;
    }

  private:
    RecordingMultiThreader & m_Threader;
  };

  std::mutex m_Mutex;
  std::set<std::thread::id> m_Threads;
  std::size_t m_AtOnce{ 0 };
  std::size_t m_MostAtOnce{ 0 };
  itk::ThreadIdType m_MostWorkUnits{ 0 };
};

/** While it lives, each new MultiThreaderBase of the process is a recording one. */
class ThreaderRecords
{
public:
  ITK_DISALLOW_COPY_AND_MOVE(ThreaderRecords);

  ThreaderRecords()
  {
    itk::ObjectFactoryBase::RegisterFactory(m_Factory);
  }
  ~ThreaderRecords()
  {
    itk::ObjectFactoryBase::UnRegisterFactory(m_Factory);
  }

  /** Of all that were made. */
  itk::ThreadIdType
  GetMostWorkUnits() const
  {
    itk::ThreadIdType most = 0;
    for (const RecordingMultiThreader::Pointer & threader : m_Factory->m_Threaders)
    {
      most = std::max(most, threader->GetMostWorkUnits());
    }
    return most;
  }
  std::set<std::thread::id>
  GetThreads() const
  {
    std::set<std::thread::id> threads;
    for (const RecordingMultiThreader::Pointer & threader : m_Factory->m_Threaders)
    {
      threads.insert(threader->GetThreads().begin(), threader->GetThreads().end());
    }
    return threads;
  }

private:
  class Factory : public itk::ObjectFactoryBase
  {
  public:
    using Self = Factory;
    using Superclass = itk::ObjectFactoryBase;
    using Pointer = itk::SmartPointer<Self>;

    itkFactorylessNewMacro(Self);
    itkTypeMacro(Factory, ObjectFactoryBase);

    const char *
    GetITKSourceVersion() const override
    {
      return ITK_SOURCE_VERSION;
    }
    const char *
    GetDescription() const override
    {
      return "threaders that record";
    }

    std::vector<RecordingMultiThreader::Pointer> m_Threaders;

  protected:
    Factory() = default;

    itk::LightObject::Pointer
    CreateObject(const char * name) override
    {
      if (std::string(name) != typeid(itk::MultiThreaderBase).name())
      {
        return nullptr;
      }
      const std::lock_guard<std::mutex> lock(m_Mutex);
      m_Threaders.push_back(RecordingMultiThreader::New());
      return m_Threaders.back().GetPointer();
    }

  private:
    std::mutex m_Mutex;
  };

  Factory::Pointer m_Factory{ Factory::New() };
};

} // namespace filtertest

#endif
