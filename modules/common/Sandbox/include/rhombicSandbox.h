#ifndef rhombicSandbox_h
#define rhombicSandbox_h

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace rhombic
{

/** Limits of a child. */
struct SandboxLimits
{
  std::uintmax_t memory = 512u << 20; ///< bytes besides the file, and four times the size of a piece
  unsigned int seconds = 5;           ///< processor time for a piece; one more second for each 4 MiB of it
  unsigned int patience = 4;          ///< limit of wall clock time, as a multiple of the limit of processor time
};

/** A file that a child unpacks, and how. */
struct SandboxJob
{
  std::string helper; ///< the name of the program whose function does it
  std::filesystem::path path;
  std::string arguments;     ///< for the function
  std::size_t pieceSize = 0; ///< the largest number of bytes of a piece of the result
  SandboxLimits limits = {};
};

/** A part of an unpacked file: bytes that are aligned for any number. */
struct SandboxPiece
{
  const std::byte * data;
  std::size_t size;
};

class SandboxProcess;

/** \class SandboxRun
 * \brief Unpacks a file in a child process: a file that crashes its decoder, hangs it or makes it take all memory
 * becomes a Failure that names the file.
 *
 * The child is a helper, a small program of one thread, in the folder of this program, in `../libexec/rhombic` beside
 * it, or where the CMake package Rhombic was found. It gets the open file, and can open no other; README.md tells its
 * limits. Children are kept for further files and end with this process: there are as many as files were unpacked at
 * once. Each has one file at a time. When a child fails that has served before, a new one tries again, so that what one
 * file has damaged in a child is not taken for damage of another file.
 *
 * Thread safety: one thread per object; any number of objects at once. */
class SandboxRun
{
public:
  /** Begins. Throws Failure: Unreadable, naming the file, when it can't be opened or is no regular file; Internal when
   * the helper is not there or can't be started. Throws std::bad_alloc. */
  explicit SandboxRun(const SandboxJob & job);

  /** Ends the child unless Next() has told that there are no more pieces: then it is kept. */
  ~SandboxRun();

  SandboxRun(const SandboxRun &) = delete;
  SandboxRun &
  operator=(const SandboxRun &) = delete;

  /** Waits for the next piece, which is valid until the next call; nothing after the last one. Throws Failure:
   * Unreadable, naming the file, when it is damaged or not supported, or when its decoder crashed or took too long;
   * Internal, Memory. */
  std::optional<SandboxPiece>
  Next();

private:
  const SandboxJob m_Job;
  std::unique_ptr<SandboxProcess> m_Process; ///< null after the last piece
  bool m_HadOtherFiles;                      ///< whether the process has served before
  bool m_HasPiece = false;
};

} // namespace rhombic

#endif
