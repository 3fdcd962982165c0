// Failures while a file is written: the old file stays or the new one is complete, and no temporary file is left.

#include "rhombicSurfaceTest.h"

#include "rhombicAtomicFile.h"

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace
{

using rhombic::WriteSurfaces;

class SurfaceFailures : public SurfaceTest
{};

/** Runs an action in a process of its own and returns its status from wait(). The exit code is 0 for success, the kind
 * of the failure, or 100 if its message does not contain \a named. */
int
InChild(const std::function<void()> & action, const std::string & named = {})
{
  const pid_t child = fork();
  if (child == 0)
  {
    try
    {
      action();
    }
    catch (const rhombic::Failure & failure)
    {
      _exit(std::string(failure.GetDescription()).find(named) == std::string::npos
              ? 100
              : static_cast<int>(failure.GetKind()));
    }
    _exit(0);
  }
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  return status;
}

bool
FailedAsOutput(int status)
{
  return WIFEXITED(status) && WEXITSTATUS(status) == static_cast<int>(rhombic::FailureKind::Output);
}

void
LimitFileSize(rlim_t bytes)
{
  const rlimit limit{ bytes, bytes };
  setrlimit(RLIMIT_FSIZE, &limit);
}

TEST_F(SurfaceFailures, DevicesAreRefused)
{
  fs::create_symlink("/dev/full", m_Folder / "full.ply");
  EXPECT_EQ(KindOf(
              [&] {
                WriteSurfaces({ { "a", MakeSphere(1) } }, m_Folder / "full.ply");
              },
              "not a regular file"),
            rhombic::FailureKind::Output);
  EXPECT_EQ(KindOf(
              [&] {
                WriteSurfaces({ { "a", MakeSphere(1) } }, "/dev/full");
              },
              "/dev/full"),
            rhombic::FailureKind::Usage)
    << "it has no extension";
  EXPECT_EQ(CountFiles(), 1u);
}

TEST_F(SurfaceFailures, FileSizeLimitIsAnErrorWhereTheProgramIgnoresItsSignal)
{
  const SceneSurface sphere{ "sphere", MakeSphere(5) };
  for (const std::string extension : Extensions)
  {
    const fs::path path = m_Folder / ("sphere" + extension);
    WriteSurfaces({ { "older", MakeSphere(1) } }, path);
    const std::string before = ReadBytes(path);
    const int status = InChild(
      [&] {
        rhombic::RemoveTemporaryFilesOnSignals();
        LimitFileSize(20000);
        WriteSurfaces({ sphere }, path);
      },
      "File too large");
    EXPECT_TRUE(FailedAsOutput(status)) << extension << status;
    EXPECT_EQ(ReadBytes(path), before) << extension;
  }
  EXPECT_EQ(CountFiles(), 7u);
}

TEST_F(SurfaceFailures, FileSizeLimitThatKillsLeavesTheOldFileAndTheNextWriteCleansUp)
{
  const SceneSurface sphere{ "sphere", MakeSphere(5) };
  for (const std::string extension : Extensions)
  {
    const fs::path path = m_Folder / ("sphere" + extension);
    WriteSurfaces({ { "older", MakeSphere(1) } }, path);
    const std::string before = ReadBytes(path);
    const std::size_t files = CountFiles();
    const int status = InChild([&] {
      std::signal(SIGXFSZ, SIG_DFL);
      LimitFileSize(20000);
      WriteSurfaces({ sphere }, path);
    });
    EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ) << extension << status;
    EXPECT_EQ(ReadBytes(path), before) << extension;
    EXPECT_EQ(CountFiles(), files + rhombic::SurfaceFilesOf(path).size()) << "the parts that were written";
    WriteSurfaces({ sphere }, path);
    EXPECT_EQ(CountFiles(), files);
  }
}

/** A small file system of some kilobytes, in a process that may mount one. */
bool
MountSmallDisk(const fs::path & folder)
{
  return mount("none", folder.c_str(), "tmpfs", 0, "size=64k") == 0;
}

TEST_F(SurfaceFailures, FullDiskLeavesTheOldFileAndNothingElse)
{
  const fs::path disk = m_Folder / "disk";
  fs::create_directory(disk);
  if (!MountSmallDisk(disk))
  {
    GTEST_SKIP() << "mounting is not permitted here";
  }
  const SceneSurface large{ "large", MakeSphere(6) };
  for (const std::string extension : Extensions)
  {
    const fs::path path = disk / ("sphere" + extension);
    WriteSurfaces({ { "older", MakeSphere(1) } }, path);
    const std::string before = ReadBytes(path);
    EXPECT_EQ(KindOf([&] { WriteSurfaces({ large }, path); }, "No space left on device"), rhombic::FailureKind::Output);
    EXPECT_EQ(ReadBytes(path), before) << extension;
    fs::remove(path);
    fs::remove(disk / "sphere.mtl");
    EXPECT_EQ(std::distance(fs::directory_iterator(disk), fs::directory_iterator()), 0) << extension;
  }
  umount(disk.c_str());
}

TEST_F(SurfaceFailures, ReadOnlyAndMissingFolders)
{
  const fs::path closed = m_Folder / "closed";
  fs::create_directory(closed);
  WriteSurfaces({ { "older", MakeSphere(1) } }, closed / "a.stl");
  const std::string before = ReadBytes(closed / "a.stl");
  fs::permissions(m_Folder, fs::perms(0711));
  fs::permissions(closed, fs::perms(0555));
  for (const std::string extension : Extensions)
  {
    const int status = InChild(
      [&] {
        if (geteuid() == 0 && seteuid(65534) != 0) // to root, nothing is closed
        {
          throw rhombic::Failure(rhombic::FailureKind::Output, "Permission denied, as far as root can tell.");
        }
        WriteSurfaces({ { "a", MakeSphere(1) } }, closed / ("a" + extension));
      },
      "Permission denied");
    EXPECT_TRUE(FailedAsOutput(status)) << extension << status;
  }
  EXPECT_EQ(ReadBytes(closed / "a.stl"), before);
  fs::permissions(closed, fs::perms::owner_all);

  const std::vector<SceneSurface> sphere{ { "a", MakeSphere(1) } };
  EXPECT_EQ(KindOf([&] { WriteSurfaces(sphere, m_Folder / "missing" / "a.glb"); }, "missing"),
            rhombic::FailureKind::Output);
  fs::create_directory(m_Folder / "folder.ply");
  EXPECT_EQ(KindOf([&] { WriteSurfaces(sphere, m_Folder / "folder.ply"); }, "it is a folder"),
            rhombic::FailureKind::Output);
  EXPECT_EQ(CountFiles(), 2u);
}

TEST_F(SurfaceFailures, MaterialsThatCannotBeWrittenKeepTheObject)
{
  fs::create_directory(m_Folder / "a.mtl");
  WriteBytes(m_Folder / "a.obj", "older");
  EXPECT_EQ(KindOf(
              [&] {
                WriteSurfaces({ { "a", MakeSphere(1) } }, m_Folder / "a.obj");
              },
              "a.mtl"),
            rhombic::FailureKind::Output);
  EXPECT_EQ(ReadBytes(m_Folder / "a.obj"), "older");
  EXPECT_EQ(CountFiles(), 2u);
}

TEST_F(SurfaceFailures, KilledAtAnyMomentTheFileIsTheOldOrTheNewOne)
{
  // Two scenes alternate; each writer is killed after a random time. The file must be one of the two.
  const std::vector<SceneSurface> small{ { "small", MakeSphere(4) } };
  const std::vector<SceneSurface> large{ { "large", MakeSphere(5) } };
  std::mt19937 random(5);
  for (const std::string extension : Extensions)
  {
    const fs::path path = m_Folder / ("sphere" + extension);
    const auto start = std::chrono::steady_clock::now();
    WriteSurfaces(large, path);
    WriteSurfaces(small, path);
    const auto duration =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - start);
    int killed = 0;
    for (int n = 0; n < 20; ++n)
    {
      const pid_t child = fork();
      if (child == 0)
      {
        for (bool isLarge = true;; isLarge = !isLarge)
        {
          WriteSurfaces(isLarge ? large : small, path);
        }
      }
      std::this_thread::sleep_for(duration * (random() % 1000) / 500);
      kill(child, SIGKILL);
      int status = 0;
      ASSERT_EQ(waitpid(child, &status, 0), child);
      killed += WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL;
      const auto triangles = ReadSurfaces(path)[0].surface->GetNumberOfTriangles();
      EXPECT_TRUE(triangles == 2048 || triangles == 8192) << extension << triangles;
    }
    EXPECT_EQ(killed, 20);
    WriteSurfaces(small, path);
    EXPECT_EQ(ReadSurfaces(path)[0].surface->GetNumberOfTriangles(), 2048u);
    fs::remove(path);
    fs::remove(fs::path(path).replace_extension(".mtl"));
    EXPECT_EQ(CountFiles(), 0u) << extension << ": parts of killed writers are left";
  }
}

TEST_F(SurfaceFailures, WritersOfTheSameFileDoNotDisturbEachOther)
{
  const fs::path path = m_Folder / "sphere.ply";
  const std::vector<SceneSurface> sphere{ { "sphere", MakeSphere(4) } };
  std::vector<std::thread> writers;
  for (int n = 0; n < 4; ++n)
  {
    writers.emplace_back([&] {
      for (int turn = 0; turn < 10; ++turn)
      {
        EXPECT_NO_THROW(WriteSurfaces(sphere, path));
      }
    });
  }
  for (std::thread & writer : writers)
  {
    writer.join();
  }
  EXPECT_EQ(ReadSurfaces(path)[0].surface->GetNumberOfTriangles(), 2048u);
  EXPECT_EQ(CountFiles(), 1u);
}

} // namespace
