#include "rhombicBatchJournal.h"

#include "rhombicFailure.h"
#include "rhombicFiles.h"
#include "rhombicWording.h"

#include <algorithm>
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

/** Whether a value is of the type of an example. Objects may lack members of the example, but for objects in arrays,
 * and have others; elements of arrays are as the first of the example's. Null stands for a number or null. */
bool
IsLike(const Report & value, const Report & example, bool isElement = false)
{
  if (example.is_object())
  {
    return value.is_object() && std::all_of(example.items().begin(), example.items().end(), [&](const auto & member) {
             return value.contains(member.key()) ? IsLike(value[member.key()], member.value()) : !isElement;
           });
  }
  if (example.is_array())
  {
    return value.is_array() && std::all_of(value.begin(), value.end(), [&](const Report & element) {
             return IsLike(element, example.front(), true);
           });
  }
  return example.is_null() ? value.is_null() || value.is_number()
                           : value.type_name() == std::string(example.type_name());
}

/** Whether a line is the record of a case: another one was not written by a batch, or not to its end. */
bool
IsRecord(const Report & line)
{
  static const Report example = Report::parse(R"({
    "case": "", "folder": "", "status": "", "cause": "", "options": "", "software": "", "seconds": 0, "peakMemory": 0,
    "input": { "md5": "", "stamp": "" },
    "steps": [ { "output": "", "seconds": 0 } ],
    "outputs": [ { "name": "", "bytes": 0 } ],
    "failedOutputs": [ "" ],
    "measures": [ { "surface": "" } ],
    "agreement": [ { "output": "", "label": "", "status": "", "volume_difference_ml": null,
                     "volume_difference_percent": null, "dice": null, "iou": null, "hd_mm": null, "hd95_mm": null,
                     "masd_mm": null, "assd_mm": null, "nsd": null, "centroid_shift_mm": null } ]
  })");
  return IsLike(line, example) && line.contains("case");
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
  std::ifstream stream = OpenIfThere(folder / journalFile);
  std::string line;
  while (std::getline(stream, line))
  {
    Report report = Report::parse(line, nullptr, false);
    if (IsRecord(report))
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
  std::error_code closed;
  if (fs::exists(folder, error) && !fs::exists(m_Path, closed) && (closed || !fs::is_empty(folder, closed)))
  {
    const std::string why =
      closed ? "can't be looked into: " + closed.message() : "holds something else than the outputs of a batch";
    throw Failure(FailureKind::Output, "The folder " + folder.string() + " " + why + "; name a new or empty one.");
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
