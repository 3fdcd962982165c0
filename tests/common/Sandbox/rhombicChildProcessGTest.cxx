#include "rhombicChildProcess.h"

#include "rhombicFailure.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

namespace
{

using rhombic::ChildProcess;
using rhombic::ChildSettings;

class ChildProcesses : public testing::Test
{
protected:
  const rhombictest::TemporaryFolder m_TemporaryFolder;

  ChildSettings
  Shell(const std::string & script) const
  {
    ChildSettings settings;
    settings.arguments = { "/bin/sh", "-c", script };
    settings.output = m_TemporaryFolder.Path() / "output";
    return settings;
  }

  std::string
  Text(const std::string & name) const
  {
    std::ifstream file(m_TemporaryFolder.Path() / name);
    return { std::istreambuf_iterator<char>(file), {} };
  }
};

TEST_F(ChildProcesses, TellHowTheyEnded)
{
  ChildSettings settings = this->Shell("cat; echo no >&2; exit 0");
  settings.input = m_TemporaryFolder.Path() / "input";
  std::ofstream(settings.input) << "some text";
  ChildProcess good(settings);
  good.Wait();
  EXPECT_TRUE(good.HasEnded());
  EXPECT_EQ(good.GetExitCode(), 0);
  EXPECT_GT(good.GetPeakMemory(), 100u << 10);
  EXPECT_EQ(this->Text("output"), "some text");
  ChildProcess bad(this->Shell("cat; exit 7"));
  bad.Wait();
  EXPECT_EQ(bad.GetExitCode(), 7);
  ChildProcess killed(this->Shell("kill -TERM $$"));
  killed.Wait();
  EXPECT_EQ(killed.GetExitCode(), -SIGTERM);
}

TEST_F(ChildProcesses, HaveNeitherOpenFilesNorHandlersOfTheProgram)
{
  const int file = open("/dev/null", O_RDONLY); // without O_CLOEXEC
  const auto before = std::signal(SIGTERM, [](int) {});
  ChildProcess child(this->Shell("ls /proc/self/fd | wc -l; kill -TERM $$; echo ignored"));
  child.Wait();
  std::signal(SIGTERM, before);
  close(file);
  EXPECT_EQ(this->Text("output"), "4\n") << "standard streams, and the folder";
  EXPECT_EQ(child.GetExitCode(), -SIGTERM);
}

TEST_F(ChildProcesses, AreLimitedInMemory)
{
  ChildSettings settings = this->Shell("while [ $(ulimit -d) = unlimited ]; do :; done; head -c 100000000 /dev/zero | "
                                       "tail -c 100000000 >/dev/null && echo done");
  settings.memory = 20u << 20;
  ChildProcess child(settings);
  child.Wait();
  EXPECT_NE(child.GetExitCode(), 0);
}

TEST_F(ChildProcesses, AreKilledWithTheObjectAndWhatTheyHaveStarted)
{
  {
    ChildProcess child(this->Shell("sleep 1000 & echo $!; sleep 1000"));
    while (this->Text("output").empty())
    {
      usleep(1000);
    }
    EXPECT_FALSE(child.HasEnded());
  }
  const pid_t grandchild = std::stoi(this->Text("output"));
  const auto isRunning = [grandchild] {
    std::ifstream file("/proc/" + std::to_string(grandchild) + "/stat");
    const std::string text{ std::istreambuf_iterator<char>(file), {} };
    return !text.empty() && text[text.rfind(')') + 2] != 'Z';
  };
  while (isRunning())
  {
    usleep(1000);
  }
}

TEST_F(ChildProcesses, ProgramsThatCanNotStartAreNamed)
{
  ChildSettings settings = this->Shell("");
  settings.arguments[0] = "/no/such/program";
  try
  {
    const ChildProcess child(settings);
    ADD_FAILURE() << "it was started";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_STREQ(failure.GetDescription(), "Cannot start /no/such/program: No such file or directory.");
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Internal);
  }
}

/** A disk that is full is no defect of the program. */
TEST_F(ChildProcesses, OutputsThatCanNotBeMadeAreNamed)
{
  ChildSettings settings = this->Shell("");
  settings.output = "/no/such/output";
  try
  {
    const ChildProcess child(settings);
    ADD_FAILURE() << "it was started";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_STREQ(failure.GetDescription(), "Cannot write /no/such/output: No such file or directory.");
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Output);
  }
}

/** A process may have so few files open that none is left for the pipe to a child. */
#ifndef __SANITIZE_ADDRESS__ // UndefinedBehaviorSanitizer looks at memory through a pipe
TEST_F(ChildProcesses, NoMoreFilesAreNoDefect)
{
  const ChildSettings settings = this->Shell("true");
  rlimit before{};
  getrlimit(RLIMIT_NOFILE, &before);
  const rlimit none{ 3, before.rlim_max };
  setrlimit(RLIMIT_NOFILE, &none);
  rhombic::FailureKind kind{};
  try
  {
    const ChildProcess child(settings);
  }
  catch (const rhombic::Failure & failure)
  {
    kind = failure.GetKind();
  }
  setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_EQ(kind, rhombic::FailureKind::Memory);
}
#endif

TEST_F(ChildProcesses, HelpersOfAnotherVersionDoNotRun)
{
  ChildSettings settings = this->Shell("");
  settings.arguments = { RHOMBIC_PROGRAM_FOLDER "/../libexec/rhombic/rhombic-unpack-test", "0.0.0" };
  ChildProcess helper(settings);
  helper.Wait();
  EXPECT_EQ(helper.GetExitCode(), 127);
}

} // namespace
