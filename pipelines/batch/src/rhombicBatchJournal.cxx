#include "rhombicBatchJournal.h"

#include "rhombicFailure.h"
#include "rhombicWording.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace rhombic
{
namespace
{

constexpr char journalFile[] = "journal.jsonl";

/** Sets or removes the lock of a range of the file, whose bytes need not exist: byte 0 for adding lines, one byte for
 * each case. \a length 0 is all that follows. Such locks belong to the open file and work on shared folders, too. */
bool
Lock(int descriptor, int command, short type, off_t start, off_t length)
{
  struct flock range = {};
  range.l_type = type;
  range.l_whence = SEEK_SET;
  range.l_start = start;
  range.l_len = length;
  return fcntl(descriptor, command, &range) == 0;
}

/** The byte that stands for a case. */
off_t
ByteOf(const std::string & name)
{
  constexpr std::size_t digits = 15; // fewer than 63 bits
  return static_cast<off_t>(std::stoull(HashText(name).substr(0, digits), nullptr, 16)) + 1;
}

Failure
CannotWrite(const fs::path & path)
{
  return Failure(FailureKind::Output, "Cannot write " + path.string() + ": " + std::strerror(errno) + ".");
}

} // namespace

CaseRecords
ReadJournal(const fs::path & folder)
{
  CaseRecords records;
  std::ifstream stream(folder / journalFile);
  std::string line;
  while (std::getline(stream, line))
  {
    Report report = Report::parse(line, nullptr, false); // a line that a killed process has left is none
    if (report.is_object() && report.contains("case"))
    {
      const auto name = report["case"].get<std::string>();
      records[name] = std::move(report);
    }
  }
  return records;
}

BatchJournal::BatchJournal(const fs::path & folder, const std::vector<std::string> & cases)
  : m_Path(folder / journalFile)
{
  std::error_code error;
  const bool hasFiles = fs::exists(folder, error) && !fs::is_empty(folder, error);
  if (hasFiles && !fs::exists(m_Path, error))
  {
    throw Failure(FailureKind::Output,
                  "The folder " + folder.string() +
                    " holds something else than the outputs of a batch; name a new or empty one.");
  }
  fs::create_directories(folder, error);
  m_Descriptor = open(m_Path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (m_Descriptor < 0)
  {
    throw CannotWrite(m_Path);
  }
  bool isLocked = !cases.empty() || Lock(m_Descriptor, F_OFD_SETLK, F_WRLCK, 1, 0);
  for (const std::string & name : cases)
  {
    isLocked = isLocked && Lock(m_Descriptor, F_OFD_SETLK, F_WRLCK, ByteOf(name), 1);
  }
  if (!isLocked)
  {
    close(m_Descriptor);
    throw Failure(FailureKind::Output,
                  "Another run writes to " + folder.string() + "; wait until it ends, or name another folder.");
  }
  m_Records = ReadJournal(folder);
}

BatchJournal::~BatchJournal()
{
  close(m_Descriptor);
}

void
BatchJournal::Add(const Report & line)
{
  std::string text = line.dump(-1, ' ', false, Report::error_handler_t::replace) + '\n';
  const bool isLocked = Lock(m_Descriptor, F_OFD_SETLKW, F_WRLCK, 0, 1);
  char last = '\n';
  const off_t size = lseek(m_Descriptor, 0, SEEK_END);
  if (size > 0 && pread(m_Descriptor, &last, 1, size - 1) == 1 && last != '\n')
  {
    text.insert(0, 1, '\n'); // ends the line that a killed process has left
  }
  const ssize_t written = isLocked ? write(m_Descriptor, text.data(), text.size()) : -1;
  const bool isWhole = written == static_cast<ssize_t>(text.size());
  if (written >= 0 && !isWhole)
  {
    errno = ENOSPC; // a full disk takes a part of the line without an error
  }
  const bool isWritten = isWhole && fsync(m_Descriptor) == 0;
  if (!isWritten)
  {
    throw CannotWrite(m_Path);
  }
  Lock(m_Descriptor, F_OFD_SETLK, F_UNLCK, 0, 1);
  m_Records[line["case"].get<std::string>()] = line;
}

} // namespace rhombic
