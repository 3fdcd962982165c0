#include "rhombicIsolatedDecoder.h"

#include "rhombicDecodingMessages.h"
#include "rhombicDecodingServer.h"
#include "rhombicFailure.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <iterator>
#include <mutex>
#include <new>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

namespace rhombic
{
namespace
{

/** Memory of a fixed size that can be shared with another process. */
class SharedMemory
{
public:
  explicit SharedMemory(std::size_t size)
    : m_Descriptor(memfd_create("decoded", MFD_CLOEXEC | MFD_ALLOW_SEALING))
    , m_Size(size)
  {
    if (m_Descriptor.Get() < 0 || ftruncate(m_Descriptor.Get(), static_cast<off_t>(size)) != 0)
    {
      throw std::bad_alloc();
    }
    // Seals keep the worker from removing pages that this process reads.
    fcntl(m_Descriptor.Get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_GROW);
    m_Address = mmap(nullptr, size, PROT_READ, MAP_SHARED, m_Descriptor.Get(), 0);
    if (m_Address == MAP_FAILED)
    {
      throw std::bad_alloc();
    }
  }
  ~SharedMemory()
  {
    munmap(m_Address, m_Size);
  }
  SharedMemory(const SharedMemory &) = delete;
  SharedMemory &
  operator=(const SharedMemory &) = delete;

  int
  GetDescriptor() const
  {
    return m_Descriptor.Get();
  }

  std::size_t
  GetSize() const
  {
    return m_Size;
  }

  const std::byte *
  GetData() const
  {
    return static_cast<const std::byte *>(m_Address);
  }

private:
  FileDescriptor m_Descriptor;
  std::size_t m_Size;
  void * m_Address = nullptr;
};

/** A worker process, the socket to it, and the memory for what it decodes. */
struct Worker
{
  pid_t pid = -1;
  FileDescriptor socket;
  std::unique_ptr<SharedMemory> memory;
};

/** Whether a signal is caused by the process's own code, and not sent from outside. */
bool
IsOwnFault(int signal)
{
  constexpr int faults[] = { SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGXFSZ, SIGXCPU };
  return std::find(std::begin(faults), std::end(faults), signal) != std::end(faults);
}

std::string
NameOfSignal(int signal)
{
  const char * const name = sigabbrev_np(signal);
  return "SIG" + std::string(name == nullptr ? "?" : name);
}

/** How a worker ended without a reply, as part of a sentence. */
std::string
DescribeEnd(int status, unsigned int seconds)
{
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
  {
    return "its decoder took more than " + std::to_string(seconds) + " seconds";
  }
  if (WIFSIGNALED(status))
  {
    return "its decoder crashed (" + NameOfSignal(WTERMSIG(status)) + ")";
  }
  return "its decoder ended without an answer";
}

Failure
UnreadableBecause(const VoxelRequest & request, const std::string & why)
{
  return Failure(FailureKind::Unreadable,
                 "Cannot read " + request.path.string() + ": " + why +
                   "; it is damaged, so copy it again from its source.");
}

} // namespace

/** The server and the idle workers. */
class IsolatedDecoder::Pool
{
public:
  Pool(unsigned int size, const Limits & limits)
    : m_Size(size)
    , m_Limits(limits)
  {
    FileDescriptor otherEnd;
    if (!MakeSocketPair(m_Socket, otherEnd))
    {
      throw this->NoProcess();
    }
    std::fflush(nullptr); // else the children would print the buffered text again
    std::cout.flush();
    std::cerr.flush();
    m_Server = fork();
    if (m_Server == 0)
    {
      m_Socket.Close();
      RunDecodingServer(otherEnd.Get());
    }
    if (m_Server < 0)
    {
      throw this->NoProcess();
    }
  }

  ~Pool()
  {
    m_Idle.clear();
    m_Socket.Close();
    while (waitpid(m_Server, nullptr, 0) < 0 && errno == EINTR)
    {}
  }

  unsigned int
  GetSize() const
  {
    return m_Size;
  }

  std::unique_ptr<VoxelBuffer>
  Decode(const VoxelRequest & request)
  {
    Worker worker = this->TakeWorker();
    WorkerRequest message;
    message.decode = request.decode;
    message.size = request.size;
    message.memory = m_Limits.memory + 5 * std::uint64_t{ request.size };
    message.seconds = m_Limits.seconds + request.size / (4u << 20);
    const int newMemory = ProvideMemory(worker, request.size);
    if (!SendMessage(worker.socket.Get(), message, request.path.string(), newMemory))
    {
      throw this->EndOf(std::move(worker), request, message);
    }
    const auto reply =
      this->WaitForReply(worker, message) ? ReceiveMessage<WorkerReply>(worker.socket.Get()) : std::nullopt;
    if (!reply || reply->message.mark != WorkerReply::Mark || reply->message.size > request.size)
    {
      throw this->EndOf(std::move(worker), request, message);
    }
    if (reply->message.failure != 0)
    {
      this->WaitForEnd(worker);
      throw this->FailureOf(*reply, request);
    }
    return std::make_unique<WorkersBuffer>(*this, std::move(worker), reply->message.size);
  }

private:
  /** Bytes in the memory of a worker, which becomes idle when the buffer is deleted. */
  class WorkersBuffer : public VoxelBuffer
  {
  public:
    WorkersBuffer(Pool & pool, Worker worker, std::size_t size)
      : m_Pool(pool)
      , m_Worker(std::move(worker))
      , m_Size(size)
    {}

    ~WorkersBuffer() override
    {
      m_Pool.GiveBack(std::move(m_Worker));
    }

    const std::byte *
    GetData() const override
    {
      return m_Worker.memory->GetData();
    }

    std::size_t
    GetSize() const override
    {
      return m_Size;
    }

  private:
    Pool & m_Pool;
    Worker m_Worker;
    std::size_t m_Size;
  };

  /** Gives a worker enough memory for its bytes. Returns the descriptor of new memory, or -1 if the old one is large
   * enough. */
  static int
  ProvideMemory(Worker & worker, std::size_t size)
  {
    if (worker.memory && worker.memory->GetSize() >= size)
    {
      return -1;
    }
    worker.memory.reset();
    worker.memory = std::make_unique<SharedMemory>(std::max<std::size_t>(size, 1));
    return worker.memory->GetDescriptor();
  }

  static Failure
  NoProcess()
  {
    return Failure(FailureKind::Internal,
                   std::string("Cannot start a process that decodes files: ") + std::strerror(errno) +
                     "; close other programs.");
  }

  Worker
  TakeWorker()
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    if (!m_Idle.empty())
    {
      Worker worker = std::move(m_Idle.back());
      m_Idle.pop_back();
      return worker;
    }
    Worker worker;
    FileDescriptor otherEnd;
    if (!MakeSocketPair(worker.socket, otherEnd))
    {
      throw NoProcess();
    }
    SendMessage(m_Socket.Get(), ServerRequest{ ServerRequest::Kind::Start, 0 }, {}, otherEnd.Get());
    const auto reply = ReceiveMessage<ServerReply>(m_Socket.Get());
    if (!reply || reply->message.pid <= 0)
    {
      throw NoProcess();
    }
    worker.pid = reply->message.pid;
    return worker;
  }

  void
  GiveBack(Worker worker)
  {
    constexpr std::size_t largestToKeep = 64 << 20;
    if (worker.memory->GetSize() > largestToKeep)
    {
      this->End(std::move(worker));
      return;
    }
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Idle.push_back(std::move(worker));
  }

  /** False after the limit of wall clock time. */
  bool
  WaitForReply(const Worker & worker, const WorkerRequest & message) const
  {
    pollfd waiting{ worker.socket.Get(), POLLIN, 0 };
    const auto milliseconds =
      static_cast<int>(std::min<std::uint64_t>(message.seconds * m_Limits.patience * 1000, 1u << 30));
    int ready = 0;
    do
    {
      ready = poll(&waiting, 1, milliseconds);
    } while (ready < 0 && errno == EINTR);
    return ready > 0;
  }

  void
  End(Worker worker)
  {
    worker.socket.Close();
    this->WaitForEnd(worker);
  }

  int
  WaitForEnd(const Worker & worker)
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    SendMessage(m_Socket.Get(), ServerRequest{ ServerRequest::Kind::Wait, worker.pid });
    const auto reply = ReceiveMessage<ServerReply>(m_Socket.Get());
    return reply ? reply->message.status : 0;
  }

  /** Ends a worker that gave no reply or an invalid one, and returns the reason. */
  Failure
  EndOf(Worker worker, const VoxelRequest & request, const WorkerRequest & message)
  {
    pollfd closed{ worker.socket.Get(), POLLIN, 0 };
    const bool hangs = poll(&closed, 1, 0) == 0;
    const bool hasEnded = (closed.revents & POLLHUP) != 0;
    kill(worker.pid, SIGKILL); // no effect if it has ended: the server has not waited for it yet
    const int status = this->WaitForEnd(worker);
    const auto seconds = static_cast<unsigned int>(message.seconds);
    if (hangs)
    {
      return UnreadableBecause(
        request, "its decoder took more than " + std::to_string(seconds * m_Limits.patience) + " seconds on the clock");
    }
    if (!hasEnded)
    {
      return UnreadableBecause(request, "its decoder gave an answer that makes no sense");
    }
    if (WIFSIGNALED(status) && !IsOwnFault(WTERMSIG(status)))
    {
      const bool isMemory = WTERMSIG(status) == SIGKILL; // the signal of the kernel when memory runs out
      return Failure(isMemory ? FailureKind::Memory : FailureKind::Internal,
                     "Cannot read " + request.path.string() + ": its decoder was killed from outside (" +
                       NameOfSignal(WTERMSIG(status)) + ")" + (isMemory ? ", as happens when memory runs out" : "") +
                       "; try again" + (isMemory ? " with other programs closed." : "."));
    }
    return UnreadableBecause(request, DescribeEnd(status, seconds));
  }

  Failure
  FailureOf(const ReceivedMessage<WorkerReply> & reply, const VoxelRequest & request) const
  {
    if (reply.message.failure == static_cast<std::int32_t>(FailureKind::Memory))
    {
      return UnreadableBecause(
        request, "its decoder wanted more than " + std::to_string(m_Limits.memory >> 20) + " MiB besides its content");
    }
    std::string sentence = reply.text;
    std::replace_if(
      sentence.begin(), sentence.end(), [](unsigned char letter) { return letter < ' ' || letter == 127; }, ' ');
    return Failure(FailureKind::Unreadable, sentence);
  }

  unsigned int m_Size;
  Limits m_Limits;
  FileDescriptor m_Socket; ///< socket to the server
  pid_t m_Server = -1;
  std::mutex m_Mutex; ///< for messages to the server, and m_Idle
  std::vector<Worker> m_Idle;
};

IsolatedDecoder::IsolatedDecoder(unsigned int workers)
  : IsolatedDecoder(workers, Limits())
{}

IsolatedDecoder::IsolatedDecoder(unsigned int workers, const Limits & limits)
  : m_Pool(std::make_unique<Pool>(workers > 0 ? workers : std::max(1u, std::thread::hardware_concurrency()), limits))
{}

IsolatedDecoder::~IsolatedDecoder() = default;

unsigned int
IsolatedDecoder::GetNumberOfWorkers() const
{
  return m_Pool->GetSize();
}

std::unique_ptr<VoxelBuffer>
IsolatedDecoder::Decode(const VoxelRequest & request)
{
  return m_Pool->Decode(request);
}

} // namespace rhombic
