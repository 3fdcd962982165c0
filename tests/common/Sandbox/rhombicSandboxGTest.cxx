#include "rhombicSandbox.h"

#include "rhombicFailure.h"
#include "rhombicTemporaryFolder.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace
{

using rhombic::Failure;
using rhombic::FailureKind;
using rhombic::SandboxJob;
using rhombic::SandboxRun;

class Sandbox : public testing::Test
{
private:
  const rhombictest::TemporaryFolder m_TemporaryFolder;

protected:
  const fs::path m_Folder = m_TemporaryFolder.Path();

  SandboxJob
  Job(const std::string & deed, const std::string & content = "content", std::size_t pieceSize = 1024) const
  {
    std::ofstream(m_Folder / "file") << content;
    return { "rhombic-unpack-test", m_Folder / "file", deed, pieceSize };
  }

  static std::string
  Run(const SandboxJob & job)
  {
    SandboxRun run(job);
    std::string all;
    while (const auto piece = run.Next())
    {
      all.append(reinterpret_cast<const char *>(piece->data), piece->size);
    }
    EXPECT_FALSE(run.Next()) << "nor then";
    return all;
  }

  /** The sentence with which a job fails, without "Cannot read PATH: ". */
  std::string
  FailureOf(const SandboxJob & job, FailureKind kind = FailureKind::Unreadable) const
  {
    const std::string beginning = "Cannot read " + job.path.string() + ": ";
    try
    {
      return "none, but " + Run(job);
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), kind) << failure.GetDescription();
      EXPECT_EQ(std::string(failure.GetDescription()).rfind(beginning, 0), 0u) << failure.GetDescription();
      return failure.GetDescription() + beginning.size();
    }
  }
};

TEST_F(Sandbox, GivesWhatIsInTheFile)
{
  std::string content;
  for (int n = 0; n < 10000; ++n)
  {
    content += std::to_string(n) + ' ';
  }
  EXPECT_EQ(Run(this->Job("copy", content, content.size())), content);
  for (const std::size_t size : { 1, 63, 64, 1000 })
  {
    EXPECT_EQ(Run(this->Job("copy", content.substr(0, 4000), size)), content.substr(0, 4000)) << size;
  }
  EXPECT_EQ(Run(this->Job("copy", "")), "");
  EXPECT_EQ(Run(this->Job(std::string(100000, 'x'))), "100000") << "of arguments";
}

TEST_F(Sandbox, OneChildServesManyFilesButOneAtATime)
{
  const std::string process = Run(this->Job("process"));
  EXPECT_EQ(Run(this->Job("process")), process);
  SandboxRun first(this->Job("process"));
  SandboxRun second(this->Job("process"));
  const auto one = first.Next();
  const auto other = second.Next();
  ASSERT_TRUE(one && other);
  EXPECT_NE(std::string(reinterpret_cast<const char *>(one->data), one->size),
            std::string(reinterpret_cast<const char *>(other->data), other->size));
}

TEST_F(Sandbox, RunsMayBeLeftEarly)
{
  const std::string content(100000, 'x');
  for (const int pieces : { 0, 1, 2, 3 })
  {
    SandboxRun run(this->Job("copy", content, 100));
    for (int n = 0; n < pieces; ++n)
    {
      EXPECT_EQ(run.Next().value().size, 100u);
    }
  }
  EXPECT_EQ(Run(this->Job("copy")), "content");
}

const std::string crash = "its decoder crashed (SIGABRT); it is damaged, so copy it again from its source.";

TEST_F(Sandbox, WhateverHappensToAChildEndsInASentence)
{
  const std::string damaged = "; it is damaged, so copy it again from its source.";
  for (int n = 0; n < 2; ++n)
  {
    EXPECT_EQ(FailureOf(this->Job("crash")), crash);
    EXPECT_EQ(FailureOf(this->Job("copy and crash")), crash);
    EXPECT_EQ(FailureOf(this->Job("refuse")), "it is  a test.");
    EXPECT_EQ(FailureOf(this->Job("throw")), "an exception; copy it again from its source.");
    EXPECT_EQ(FailureOf(this->Job("print")), "it is damaged (corrupt data); copy it again from its source.");
    EXPECT_EQ(FailureOf(this->Job("babble")), "its decoder gave an answer that makes no sense" + damaged);
    EXPECT_EQ(Run(this->Job("copy")), "content") << "by another child";
  }
}

TEST_F(Sandbox, LimitsMemory)
{
  SandboxJob job = this->Job("allocate");
  job.limits.memory = 64 << 20;
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) // which keep all memory for themselves
  EXPECT_EQ(FailureOf(job).rfind("its decoder wanted more than 64 MiB besides its content; ", 0), 0u) << FailureOf(job);
#endif
  EXPECT_EQ(Run(this->Job("copy")), "content");
}

TEST_F(Sandbox, LimitsTime)
{
  SandboxJob job = this->Job("compute");
  job.limits.seconds = 1;
  job.limits.patience = 1000;
  EXPECT_EQ(FailureOf(job).rfind("its decoder took more than 1 seconds; ", 0), 0u) << FailureOf(job);
  job = this->Job("wait");
  job.limits.seconds = 1;
  job.limits.patience = 1;
  EXPECT_EQ(FailureOf(job).rfind("its decoder took more than 1 seconds on the clock; ", 0), 0u) << FailureOf(job);
  EXPECT_EQ(Run(this->Job("copy")), "content");
}

TEST_F(Sandbox, ChildrenComputeAndDoNothingElse)
{
  EXPECT_EQ(Run(this->Job("misdeeds")), "0");
}

TEST_F(Sandbox, WhatAFileHasDamagedInAChildIsNotBlamedOnTheNextOne)
{
  EXPECT_EQ(Run(this->Job("poison")), "");
  EXPECT_EQ(Run(this->Job("copy")), "content");
}

TEST_F(Sandbox, ServesManyThreads)
{
  const SandboxJob good = this->Job("copy");
  const SandboxJob deadly = this->Job("crash");
  std::vector<std::thread> threads;
  for (int n = 0; n < 6; ++n)
  {
    threads.emplace_back([&, n] {
      for (int i = 0; i < 10; ++i)
      {
        if ((n + i) % 3 == 0)
        {
          EXPECT_EQ(FailureOf(deadly), crash);
        }
        else
        {
          EXPECT_EQ(Run(good), "content");
        }
      }
    });
  }
  for (std::thread & thread : threads)
  {
    thread.join();
  }
}

TEST_F(Sandbox, FilesThatAreNoneAreRefused)
{
  SandboxJob job = this->Job("copy");
  job.path = m_Folder / "absent";
  EXPECT_EQ(FailureOf(job), "No such file or directory; check that it is there and yours.");
  job.path = m_Folder / "pipe";
  ASSERT_EQ(mkfifo(job.path.c_str(), 0600), 0);
  EXPECT_EQ(FailureOf(job), "it is a device or pipe; give a file.");
  job.path = m_Folder;
  EXPECT_EQ(FailureOf(job), "it is a device or pipe; give a file.");
}

TEST_F(Sandbox, AMissingHelperIsNamed)
{
  SandboxJob job = this->Job("copy");
  job.helper = "rhombic-unpack-nothing";
  const std::string sentence = FailureOf(job, FailureKind::Internal);
  EXPECT_NE(sentence.find("rhombic-unpack-nothing, the program that unpacks it, is not in "), std::string::npos)
    << sentence;
  EXPECT_NE(sentence.find("libexec/rhombic; install"), std::string::npos) << sentence;
}

TEST_F(Sandbox, AChildThatIsKilledIsNoDamage)
{
  const SandboxJob job = this->Job("process and wait");
  for (const int signal : { SIGKILL, SIGTERM })
  {
    SandboxRun run(job);
    const auto piece = run.Next();
    kill(std::stoi(std::string(reinterpret_cast<const char *>(piece.value().data), piece->size)), signal);
    try
    {
      run.Next();
      ADD_FAILURE() << "it was unpacked";
    }
    catch (const Failure & failure)
    {
      EXPECT_EQ(failure.GetKind(), signal == SIGKILL ? FailureKind::Memory : FailureKind::Internal);
      EXPECT_NE(std::string(failure.GetDescription()).find("killed from outside"), std::string::npos)
        << failure.GetDescription();
    }
    EXPECT_EQ(Run(this->Job("copy")), "content") << "by another child";
  }
}

/** Whether a process runs: it is there, and no zombie. */
bool
IsRunning(pid_t process)
{
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  const std::string text{ std::istreambuf_iterator<char>(file), {} };
  return !text.empty() && text[text.rfind(')') + 2] != 'Z';
}

TEST_F(Sandbox, ChildrenEndWithTheirProgram)
{
  const std::string ours = Run(this->Job("process"));
  for (const int signal : { 0, SIGKILL })
  {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const SandboxJob job = this->Job("process");
    std::fflush(nullptr); // else the fork would print it again
    const pid_t program = fork();
    if (program == 0)
    {
      const std::string child = Run(job);
      const bool isWritten = write(ends[1], child.c_str(), child.size()) > 0;
      if (signal == 0)
      {
        std::exit(isWritten ? 0 : 1);
      }
      raise(signal);
    }
    close(ends[1]);
    int status = 0;
    waitpid(program, &status, 0);
    EXPECT_EQ(signal == 0 ? WEXITSTATUS(status) : WTERMSIG(status), signal);
    char text[32] = {};
    EXPECT_GT(read(ends[0], text, sizeof(text) - 1), 0);
    close(ends[0]);
    EXPECT_NE(text, ours) << "a fork has children of its own";
    while (IsRunning(std::atoi(text)))
    {
      usleep(1000);
    }
    EXPECT_EQ(Run(this->Job("process")), ours) << "and leaves ours alone";
  }
}

} // namespace
