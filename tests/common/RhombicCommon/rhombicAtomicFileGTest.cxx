#include "rhombicAtomicFile.h"

#include "rhombicFailure.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <sstream>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{

using rhombic::AtomicFile;
using rhombic::Failure;

void
Write(const fs::path & path, const std::string & text)
{
  std::ofstream(path) << text;
}

std::string
Read(const fs::path & path)
{
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

std::size_t
FilesIn(const fs::path & folder)
{
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(AtomicFile, AppearsOnCommitOnly)
{
  const rhombictest::TemporaryFolder folder;
  const fs::path target = folder.Path() / "picture.png";
  AtomicFile file(target);
  EXPECT_EQ(file.GetTemporaryPath().extension(), ".png") << "for writers that look at the extension";
  EXPECT_EQ(file.GetTemporaryPath().parent_path(), folder.Path());
  Write(file.GetTemporaryPath(), "complete");
  EXPECT_FALSE(fs::exists(target));
  file.Commit(8);
  EXPECT_EQ(Read(target), "complete");
  EXPECT_EQ(FilesIn(folder.Path()), 1u);
}

TEST(AtomicFile, KeepsTheOldFileWithoutCommit)
{
  const rhombictest::TemporaryFolder folder;
  const fs::path target = folder.Path() / "mesh.stl";
  Write(target, "old");
  {
    AtomicFile file(target);
    Write(file.GetTemporaryPath(), "new");
  }
  EXPECT_EQ(Read(target), "old");
  EXPECT_EQ(FilesIn(folder.Path()), 1u);
}

TEST(AtomicFile, TellsAFolderThatIsMissingFromOneThatMayNotBeEntered)
{
  const rhombictest::TemporaryFolder folder;
  const auto refusal = [&folder] {
    try
    {
      const AtomicFile file(folder.Path() / "closed" / "below" / "mesh.stl");
    }
    catch (const Failure & failure)
    {
      return std::string(failure.GetDescription());
    }
    return std::string();
  };
  EXPECT_NE(refusal().find("does not exist; create it first"), std::string::npos) << refusal();
  fs::create_directories(folder.Path() / "closed" / "below");
  fs::permissions(folder.Path(), fs::perms(0755));
  fs::permissions(folder.Path() / "closed", fs::perms::none);
  const uid_t user = geteuid();
  ASSERT_EQ(seteuid(user == 0 ? 65534 : user), 0); // root may enter all
  const std::string closed = refusal();
  ASSERT_EQ(seteuid(user), 0);
  fs::permissions(folder.Path() / "closed", fs::perms::owner_all);
  EXPECT_NE(closed.find("may not be entered"), std::string::npos) << closed;
}

TEST(AtomicFile, RefusesAFileThatIsTooShort)
{
  const rhombictest::TemporaryFolder folder;
  const fs::path target = folder.Path() / "mesh.stl";
  Write(target, "old");
  {
    AtomicFile file(target);
    Write(file.GetTemporaryPath(), "new");
    EXPECT_THROW(file.Commit(4), Failure);
  }
  EXPECT_EQ(Read(target), "old");
  EXPECT_EQ(FilesIn(folder.Path()), 1u);
}

TEST(AtomicFile, TooManyOpenFilesAreNotToldAsAFullDisk)
{
  const rhombictest::TemporaryFolder folder;
  AtomicFile file(folder.Path() / "a.txt");
  rlimit before{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
  const auto refusal = [&before](const auto & work) {
    const rlimit none{ 0, before.rlim_max };
    std::string sentence;
    setrlimit(RLIMIT_NOFILE, &none);
    try
    {
      work();
    }
    catch (const Failure & failure)
    {
      sentence = std::to_string(static_cast<int>(failure.GetKind())) + " " + failure.GetDescription();
    }
    setrlimit(RLIMIT_NOFILE, &before);
    return sentence;
  };
  const std::string begin = "9 Cannot write " + folder.Path().string(),
                    end = ".txt: too many files are open; allow more by ulimit -n.";
  EXPECT_EQ(refusal([&] {
              Write(file.GetTemporaryPath(), "text"); // opens no file, and does not tell
              file.Flush(4);
            }),
            begin + "/a" + end);
  EXPECT_EQ(refusal([&] { AtomicFile(folder.Path() / "b.txt"); }), begin + "/b" + end);
}

TEST(AtomicFile, RefusesTargetsThatCannotBe)
{
  const rhombictest::TemporaryFolder folder;
  for (const fs::path & target : { folder.Path(),
                                   folder.Path() / "",
                                   folder.Path() / "missing" / "x.png",
                                   fs::path("/dev/null"),
                                   folder.Path() / (std::string(300, 'x') + ".png") })
  {
    try
    {
      AtomicFile file(target);
      ADD_FAILURE() << target;
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Output);
      EXPECT_NE(std::string(failure.GetDescription()).find(target.string()), std::string::npos);
    }
  }
  EXPECT_EQ(FilesIn(folder.Path()), 0u);
}

TEST(AtomicFile, GoesRoundTemporaryFilesLeftBehind)
{
  const rhombictest::TemporaryFolder folder;
  fs::path next;
  {
    AtomicFile file(folder.Path() / "a.png");
    next = file.GetTemporaryPath();
  }
  // The next temporary names exist already, as if a killed process with the same number had left them.
  const std::string name = next.filename().string();
  const auto end = name.rfind('-') + 1;
  const auto number = std::stoul(name.substr(end));
  std::vector<int> held;
  for (unsigned long n = number; n < number + 4; ++n)
  {
    const fs::path taken = folder.Path() / (name.substr(0, end) + std::to_string(n) + ".png");
    held.push_back(open(taken.c_str(), O_RDWR | O_CREAT, 0644));
    ASSERT_EQ(flock(held.back(), LOCK_EX), 0);
  }
  AtomicFile file(folder.Path() / "a.png");
  Write(file.GetTemporaryPath(), "new");
  file.Commit(3);
  EXPECT_EQ(Read(folder.Path() / "a.png"), "new");
  EXPECT_EQ(FilesIn(folder.Path()), 5u);
  for (const int descriptor : held)
  {
    close(descriptor);
  }
}

TEST(AtomicFile, RemovesWhatKilledProcessesLeftOfTheSameTarget)
{
  const rhombictest::TemporaryFolder folder;
  for (const std::string name : { "a.png", "a.png", "b.png" })
  {
    const pid_t child = fork();
    if (child == 0)
    {
      AtomicFile file(folder.Path() / name);
      AtomicFile second(folder.Path() / name);
      Write(file.GetTemporaryPath(), "part");
      raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
  }
  EXPECT_EQ(FilesIn(folder.Path()), 4u) << "the second process removed those of the first";
  AtomicFile living(folder.Path() / "a.png");
  AtomicFile another(folder.Path() / "a.png");
  EXPECT_EQ(FilesIn(folder.Path()), 4u) << "two of b.png and the two of this process";
  EXPECT_TRUE(fs::exists(living.GetTemporaryPath()));
}

TEST(AtomicFile, FlushedBeforeItAppears)
{
  const rhombictest::TemporaryFolder folder;
  AtomicFile file(folder.Path() / "a.png");
  EXPECT_THROW(file.Flush(1), Failure);
  Write(file.GetTemporaryPath(), "new");
  file.Flush(3);
  EXPECT_FALSE(fs::exists(folder.Path() / "a.png"));
  file.Commit(3);
  EXPECT_EQ(Read(folder.Path() / "a.png"), "new");
}

TEST(StagedFiles, AppearTogether)
{
  const rhombictest::TemporaryFolder folder;
  Write(folder.Path() / "b", "older");
  rhombic::StagedFiles staged;
  for (const char * const name : { "a", "b" })
  {
    AtomicFile & file = staged.Begin(folder.Path() / name);
    Write(file.GetTemporaryPath(), name);
    file.Flush(1);
  }
  EXPECT_FALSE(fs::exists(folder.Path() / "a"));
  EXPECT_EQ(Read(folder.Path() / "b"), "older");
  staged.Commit();
  EXPECT_EQ(Read(folder.Path() / "a"), "a");
  EXPECT_EQ(Read(folder.Path() / "b"), "b");
  EXPECT_EQ(FilesIn(folder.Path()), 2u);
}

/** Writes a file and commits it. */
TEST(StagedFiles, AreGoneWithoutCommit)
{
  const rhombictest::TemporaryFolder folder;
  {
    rhombic::StagedFiles staged;
    AtomicFile & file = staged.Begin(folder.Path() / "a");
    Write(file.GetTemporaryPath(), "a");
    file.Flush(1);
    EXPECT_THROW(staged.Begin(folder.Path() / "missing" / "b"), Failure);
  }
  EXPECT_EQ(FilesIn(folder.Path()), 0u);
}

TEST(StagedFiles, TellWhatWasReplacedBeforeAFailure)
{
  const rhombictest::TemporaryFolder folder;
  rhombic::StagedFiles staged;
  for (const char * const name : { "first", "second" })
  {
    AtomicFile & file = staged.Begin(folder.Path() / name);
    Write(file.GetTemporaryPath(), name);
    file.Flush(1);
  }
  fs::create_directories(folder.Path() / "second" / "occupied");
  try
  {
    staged.Commit();
    FAIL() << "a folder can't be replaced";
  }
  catch (const Failure & failure)
  {
    const std::string text = failure.GetDescription();
    EXPECT_NE(text.find("second"), std::string::npos) << text;
    EXPECT_NE(text.find("already in place: " + (folder.Path() / "first").string()), std::string::npos) << text;
  }
  EXPECT_EQ(Read(folder.Path() / "first"), "first");
}

TEST(AtomicFile, GoesWithTheProcessThatASignalEnds)
{
  const rhombictest::TemporaryFolder folder;
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    const pid_t child = fork();
    if (child == 0)
    {
      rhombic::RemoveTemporaryFilesOnSignals();
      AtomicFile finished(folder.Path() / "finished.png");
      Write(finished.GetTemporaryPath(), "all");
      finished.Commit(3);
      AtomicFile first(folder.Path() / "first.png");
      AtomicFile second(folder.Path() / "second.png");
      raise(signal);
      _exit(0);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == signal);
    EXPECT_EQ(FilesIn(folder.Path()), 1u) << "the finished one";
  }
}

TEST(AtomicFile, LeavesIgnoredSignalsIgnored)
{
  const auto before = std::signal(SIGHUP, SIG_IGN); // as nohup does
  rhombic::RemoveTemporaryFilesOnSignals();
  EXPECT_EQ(std::signal(SIGHUP, before), SIG_IGN);
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

TEST(AtomicFile, TwoForTheSameTargetDoNotCollide)
{
  const rhombictest::TemporaryFolder folder;
  AtomicFile first(folder.Path() / "a.png");
  AtomicFile second(folder.Path() / "a.png");
  EXPECT_NE(first.GetTemporaryPath(), second.GetTemporaryPath());
}

} // namespace
