#include "rhombicDecodingWorker.h"

#include "rhombicDecodingMessages.h"
#include "rhombicFailure.h"
#include "rhombicSystemCallFilter.h"

#include <algorithm>
#include <fstream>
#include <new>

#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

namespace rhombic
{
namespace
{

void
Limit(int resource, rlim_t value)
{
  rlimit limit{};
  getrlimit(resource, &limit);
  limit.rlim_cur = std::min(value, limit.rlim_max);
  setrlimit(resource, &limit);
}

/** The size of this process's address space in bytes. */
std::uint64_t
AddressSpace()
{
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t
SecondsUsed()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) + 1;
}

/** Sets the limits of the whole process: no core files, few open files, and small files. The output of libraries goes
 * to \a output. */
void
LimitFiles(int output)
{
  constexpr rlim_t mostOutput = 1 << 20;
  constexpr rlim_t mostFiles = 64;
  Limit(RLIMIT_CORE, 0);
  Limit(RLIMIT_FSIZE, mostOutput);
  Limit(RLIMIT_NOFILE, mostFiles);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
}

void
LimitRequest(const WorkerRequest & request)
{
  Limit(RLIMIT_AS, AddressSpace() + request.memory);
  Limit(RLIMIT_CPU, SecondsUsed() + request.seconds);
}

/** The memory for decoded bytes that is shared with the program. */
class SharedBytes
{
public:
  SharedBytes() = default;
  ~SharedBytes()
  {
    this->Unmap();
  }
  SharedBytes(const SharedBytes &) = delete;
  SharedBytes &
  operator=(const SharedBytes &) = delete;

  /** Throws std::bad_alloc. */
  void
  Map(int descriptor)
  {
    this->Unmap();
    struct stat status
    {};
    fstat(descriptor, &status);
    m_Size = static_cast<std::size_t>(status.st_size);
    m_Address = mmap(nullptr, m_Size, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (m_Address == MAP_FAILED)
    {
      throw std::bad_alloc();
    }
  }

  std::byte *
  GetData()
  {
    return static_cast<std::byte *>(m_Address);
  }

private:
  void
  Unmap()
  {
    if (m_Address != MAP_FAILED)
    {
      munmap(m_Address, m_Size);
    }
  }

  std::size_t m_Size = 0;
  void * m_Address = MAP_FAILED;
};

/** The first line that libraries printed since the last call. */
std::string
TakeOutput(int output)
{
  std::fflush(nullptr);
  std::string text(LongestMessageText / 4, '\0');
  const ssize_t count = pread(output, text.data(), text.size(), 0);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  if (ftruncate(output, 0) == 0)
  {
    lseek(output, 0, SEEK_SET);
  }
  return text.substr(0, text.find('\n'));
}

/** Decodes a file and returns the number of bytes. A printed warning is a failure, too: the codec has made up what is
 * missing. */
std::size_t
Work(const ReceivedMessage<WorkerRequest> & request, SharedBytes & bytes, int output)
{
  if (request.descriptor.Get() >= 0)
  {
    bytes.Map(request.descriptor.Get());
  }
  const std::size_t size = request.message.decode(request.text, bytes.GetData(), request.message.size);
  if (const std::string warning = TakeOutput(output); !warning.empty())
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + request.text + ": it is damaged (" + warning + "); copy it again from its source.");
  }
  return size;
}

/** Makes malloc() keep freed memory: codecs allocate the same large blocks for each file. */
void
KeepFreedMemory()
{
  constexpr int largest = 64 << 20;
  mallopt(M_MMAP_THRESHOLD, largest);
  mallopt(M_TRIM_THRESHOLD, largest);
}

} // namespace

void
RunDecodingWorker(int socket)
{
  const FileDescriptor output(memfd_create("output", MFD_CLOEXEC));
  LimitFiles(output.Get());
  KeepFreedMemory();
  ForbidAllButDecoding(); // forbids threads too: OpenJPEG's would slow down other workers
  SharedBytes bytes;
  while (const auto request = ReceiveMessage<WorkerRequest>(socket))
  {
    WorkerReply reply;
    std::string sentence;
    LimitRequest(request->message);
    try
    {
      reply.size = Work(*request, bytes, output.Get());
    }
    catch (const Failure & failure)
    {
      reply.failure = static_cast<std::int32_t>(failure.GetKind());
      sentence = failure.GetDescription();
    }
    catch (const std::bad_alloc &)
    {
      reply.failure = static_cast<std::int32_t>(FailureKind::Memory);
    }
    catch (const std::exception & error)
    {
      reply.failure = static_cast<std::int32_t>(FailureKind::Unreadable);
      sentence = "Cannot read " + request->text + ": " + DescribeError(error) + "; copy it again from its source.";
    }
    SendMessage(socket, reply, sentence);
    if (reply.failure != 0)
    {
      break;
    }
  }
  _exit(0);
}

} // namespace rhombic
