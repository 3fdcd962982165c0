#include "rhombicBatchJournal.h"

#include "rhombicFailure.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace rhombic
{

BatchJournal::BatchJournal(const fs::path & folder)
  : m_Path(folder / "journal.jsonl")
{
  std::error_code error;
  if (!fs::exists(m_Path, error) && fs::exists(folder, error) && !fs::is_empty(folder, error))
  {
    throw Failure(FailureKind::Output,
                  "The folder " + folder.string() +
                    " holds something else than the outputs of a batch; name a new or empty one.");
  }
  fs::create_directories(folder, error);
  m_Descriptor = open(m_Path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (m_Descriptor < 0)
  {
    throw Failure(FailureKind::Output, "Cannot write " + m_Path.string() + ": " + std::strerror(errno) + ".");
  }
  if (flock(m_Descriptor, LOCK_EX | LOCK_NB) != 0)
  {
    close(m_Descriptor);
    throw Failure(FailureKind::Output,
                  "Another run writes to " + folder.string() + "; wait until it ends, or name another folder.");
  }
  std::ifstream stream(m_Path);
  std::string line;
  bool isWhole = true;
  while (std::getline(stream, line))
  {
    isWhole = !stream.eof(); // the last line of a killed process has no end
    Report report = Report::parse(line, nullptr, false);
    if (report.is_object() && report.contains("case"))
    {
      const auto name = report["case"].get<std::string>();
      m_Last[name] = std::move(report);
    }
  }
  if (!isWhole && write(m_Descriptor, "\n", 1) != 1)
  {
    throw Failure(FailureKind::Output, "Cannot write " + m_Path.string() + ": " + std::strerror(errno) + ".");
  }
}

BatchJournal::~BatchJournal()
{
  close(m_Descriptor);
}

const Report *
BatchJournal::Find(const std::string & name) const
{
  const auto found = m_Last.find(name);
  return found == m_Last.end() ? nullptr : &found->second;
}

void
BatchJournal::Add(const Report & line)
{
  const std::string text = line.dump(-1, ' ', false, Report::error_handler_t::replace) + '\n';
  if (write(m_Descriptor, text.data(), text.size()) != static_cast<ssize_t>(text.size()) || fsync(m_Descriptor) != 0)
  {
    throw Failure(FailureKind::Output, "Cannot write " + m_Path.string() + ": " + std::strerror(errno) + ".");
  }
  m_Last[line["case"].get<std::string>()] = line;
}

} // namespace rhombic
