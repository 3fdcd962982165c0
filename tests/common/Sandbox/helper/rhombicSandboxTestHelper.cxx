// rhombic-unpack-test: a helper whose function does what the arguments of the job say.

#include "rhombicSandboxChild.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/socket.h>
#include <unistd.h>

namespace
{

using rhombic::SandboxInput;
using rhombic::SandboxOutput;

void
Deliver(SandboxOutput & output, const std::string & bytes)
{
  std::memcpy(output.GetBuffer(), bytes.data(), bytes.size());
  output.Deliver(bytes.size());
}

/** The file in pieces of the largest size. */
void
Copy(const SandboxInput & input, SandboxOutput & output)
{
  for (std::size_t place = 0; place < input.size;)
  {
    const std::size_t size = std::min(output.GetSize(), input.size - place);
    std::copy_n(input.file + place, size, output.GetBuffer());
    output.Deliver(size);
    place += size;
  }
}

/** How many of the deeds succeed that no child may do. */
int
CountMisdeeds()
{
  const bool misdeeds[] = { open("/dev/null", O_RDONLY) >= 0,
                            open("/tmp/rhombic-unpack-test", O_CREAT | O_WRONLY, 0600) >= 0,
                            unlink("/tmp/rhombic-unpack-test") == 0,
                            socket(AF_INET, SOCK_STREAM, 0) >= 0,
                            kill(getppid(), 0) == 0,
                            fork() >= 0,
                            execl("/bin/true", "true", nullptr) == 0 };
  return static_cast<int>(std::count(std::begin(misdeeds), std::end(misdeeds), true));
}

/** Waits for ever: takes all messages of the program. */
void
Wait()
{
  char nothing = 0;
  while (read(STDIN_FILENO, &nothing, 1) > 0)
  {}
}

void
Allocate()
{
  std::vector<std::string> blocks;
  for (int n = 0; n < 1024; ++n)
  {
    blocks.emplace_back(1 << 20, 'x');
  }
}

bool isPoisoned = false; ///< whether an earlier file has damaged this process

void
Unpack(const SandboxInput & input, SandboxOutput & output)
{
  if (isPoisoned)
  {
    std::abort();
  }
  const std::string & deed = input.arguments;
  if (deed == "copy")
  {
    Copy(input, output);
  }
  else if (deed == "crash")
  {
    std::abort();
  }
  else if (deed == "copy and crash")
  {
    Copy(input, output);
    std::abort();
  }
  else if (deed == "process")
  {
    Deliver(output, std::to_string(getpid()));
  }
  else if (deed == "process and wait")
  {
    Deliver(output, std::to_string(getpid()));
    Wait();
  }
  else if (deed == "wait")
  {
    Wait();
  }
  else if (deed == "compute")
  {
    for (volatile bool goesOn = true; goesOn;)
    {}
  }
  else if (deed == "allocate")
  {
    Allocate();
  }
  else if (deed == "print")
  {
    std::puts("corrupt data\nmore of it");
    Deliver(output, "made up");
  }
  else if (deed == "refuse")
  {
    throw rhombic::SandboxRefusal("it is\n a test");
  }
  else if (deed == "throw")
  {
    throw std::runtime_error("an exception");
  }
  else if (deed == "babble")
  {
    Deliver(output, write(STDIN_FILENO, "?", 1) == 1 ? "?" : "nothing");
  }
  else if (deed == "misdeeds")
  {
    Deliver(output, std::to_string(CountMisdeeds()));
  }
  else if (deed == "poison")
  {
    isPoisoned = true;
  }
  else
  {
    Deliver(output, std::to_string(deed.size()));
  }
}

} // namespace

int
main(int argc, char ** argv)
{
  return rhombic::RunSandboxChild(argc, argv, Unpack);
}
