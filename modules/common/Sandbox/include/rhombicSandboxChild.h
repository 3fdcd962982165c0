#ifndef rhombicSandboxChild_h
#define rhombicSandboxChild_h

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

namespace rhombic
{

/** What the function of a helper gets. */
struct SandboxInput
{
  const std::byte * file; ///< all bytes of the file; a file that is cut off while it is read ends the child
  std::size_t size;
  std::string arguments; ///< those of the job
};

/** \class SandboxOutput
 * \brief Where the function of a helper puts its result, piece by piece. */
class SandboxOutput
{
public:
  /** \a slot has place for two pieces of at most \a size bytes. \a seconds of processor time may be used for each. */
  SandboxOutput(std::byte * slot, std::size_t size, std::uint64_t seconds);

  /** Memory for the next piece, aligned for any number. */
  std::byte *
  GetBuffer() const;

  /** The largest number of bytes of a piece. */
  std::size_t
  GetSize() const
  {
    return m_Size;
  }

  /** Hands over a piece of \a size bytes. The caller uses one while the next one is made. Throws SandboxRefusal if
   * libraries have printed something, as codecs do when they make up what is missing. Ends the process if nobody wants
   * more. */
  void
  Deliver(std::size_t size);

private:
  std::byte * m_Slot;
  std::size_t m_Size;
  std::uint64_t m_Seconds;
  std::size_t m_Delivered = 0; ///< number of pieces
};

/** \class SandboxRefusal
 * \brief Why a file can't be read, as a part of a sentence: "its pixels are cut off; copy it again from its source". */
class SandboxRefusal : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/** Unpacks a file. Throws SandboxRefusal; any other exception means a damaged file, too. */
using SandboxFunction = void (*)(const SandboxInput & input, SandboxOutput & output);

/** What the main() of a helper calls and returns: gives itself the limits of a child (README.md), and calls the
 * function for each file that the program sends, until the program ends. The process must have one thread. */
int
RunSandboxChild(int argc, char ** argv, SandboxFunction function);

} // namespace rhombic

#endif
