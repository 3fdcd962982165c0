#include "rhombicConsole.h"

#include "rhombicWording.h"
#include "rhombicOptionNames.h"

#include <algorithm>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <fstream>
#include <unistd.h>

namespace rhombic
{

namespace
{

/** Replaces control characters, which names of files may contain, and which are commands to a terminal. */
std::string
Printable(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](unsigned char letter) { return letter < ' ' || letter == 127; }, '?');
  return text;
}

/** Bytes that this process had read from disks, pages of mapped files included; 0 where the system does not tell. */
double
CountBytesFromDisk()
{
  std::ifstream file("/proc/self/io");
  std::string name;
  double bytes = 0.0;
  while (file >> name >> bytes && name != "read_bytes:")
  {}
  return name == "read_bytes:" ? bytes : 0.0;
}

/** "40 s left". */
std::string
DescribeTimeLeft(double seconds)
{
  return seconds < 90.0     ? FormatFixed(seconds, 0) + " s left"
         : seconds < 5400.0 ? FormatFixed(seconds / 60.0, 0) + " min left"
                            : FormatFixed(seconds / 3600.0, 1) + " h left";
}

} // namespace

Console::Console()
  : m_IsTerminal(isatty(STDERR_FILENO) == 1)
{
  spdlog::set_default_logger(spdlog::stderr_logger_mt("rhombic"));
  spdlog::set_pattern("%v");
}

void
Console::SetVerbosity(Verbosity verbosity)
{
  m_Verbosity = verbosity;
  spdlog::set_level(verbosity == Verbosity::Quiet ? spdlog::level::err : spdlog::level::info);
  spdlog::set_pattern(verbosity == Verbosity::Verbose ? "[%H:%M:%S.%e] %v" : "%v");
}

Events
Console::MakeEvents()
{
  return { [this](const std::string & line) { this->Note(line); },
           [this](const std::string & step, double fraction) { this->Progress(step, fraction); } };
}

void
Console::Note(const std::string & line)
{
  this->Finish();
  spdlog::info("{}", Printable(NameOptions(line)));
}

void
Console::Error(const std::string & sentence)
{
  this->Finish();
  spdlog::error("rhombic: {}", Printable(sentence));
}

void
Console::Progress(const std::string & step, double fraction)
{
  const int percent = static_cast<int>(fraction * 100.0);
  if (m_Verbosity == Verbosity::Quiet || (step == m_Step && percent == m_Percent))
  {
    return;
  }
  if (step != m_Step)
  {
    this->AddTimeToStep();
    m_LastLine = m_StepStart;
    m_BytesAtStart = CountBytesFromDisk();
  }
  if (!m_IsTerminal)
  {
    constexpr std::chrono::minutes betweenLines(1);
    if (m_Verbosity == Verbosity::Verbose && step != m_Step)
    {
      spdlog::info("{} ...", step);
    }
    else if (Clock::now() - m_LastLine > betweenLines)
    {
      spdlog::info("{}: {} %{}", Printable(step), percent, this->DescribePace(fraction));
      m_LastLine = Clock::now();
    }
  }
  else
  {
    constexpr int width = 30;
    const int filled = percent * width / 100;
    const auto bar =
      std::string(static_cast<std::size_t>(filled), '#') + std::string(static_cast<std::size_t>(width - filled), '.');
    const std::string pace = step == m_Step ? this->DescribePace(fraction) : "";
    std::fprintf(stderr, "\r\033[K[%s] %3d %% %s%s", bar.c_str(), percent, step.c_str(), pace.c_str());
    std::fflush(stderr);
  }
  m_Step = step;
  m_Percent = percent;
}

void
Console::Finish()
{
  if (m_IsTerminal && m_Percent >= 0)
  {
    std::fprintf(stderr, "\r\033[K");
    std::fflush(stderr);
  }
  m_Percent = -1;
}

std::string
Console::DescribePace(double fraction) const
{
  constexpr double awhile = 5.0;      // s
  constexpr double least = 0.02;      // of a step, before it tells anything
  constexpr double worthSaying = 1e6; // bytes in a second
  const double seconds = std::chrono::duration<double>(Clock::now() - m_StepStart).count();
  if (seconds < awhile || fraction < least)
  {
    return "";
  }
  const double pace = (CountBytesFromDisk() - m_BytesAtStart) / seconds;
  return (pace > worthSaying ? ", " + FormatFixed(pace / 1e6, 0) + " MB/s from disk" : "") + ", " +
         DescribeTimeLeft(seconds * (1.0 - fraction) / fraction);
}

void
Console::AddTimeToStep()
{
  const auto now = Clock::now();
  const double seconds = std::chrono::duration<double>(now - m_StepStart).count();
  m_StepStart = now;
  const std::string kind = m_Step.substr(0, m_Step.find(' '));
  const auto known = std::find_if(
    m_StepSeconds.begin(), m_StepSeconds.end(), [&kind](const auto & entry) { return entry.first == kind; });
  if (known == m_StepSeconds.end())
  {
    m_StepSeconds.emplace_back(kind, seconds);
  }
  else
  {
    known->second += seconds;
  }
}

void
Console::NoteStepTimes()
{
  if (m_Verbosity != Verbosity::Verbose)
  {
    return;
  }
  this->AddTimeToStep();
  double sum = 0.0;
  for (const auto & [kind, seconds] : m_StepSeconds)
  {
    sum += seconds;
  }
  for (const auto & [kind, seconds] : m_StepSeconds)
  {
    this->Note(FormatFixed(seconds, 2) + " s  " + FormatFixed(100.0 * seconds / sum, 0) + " %  " + kind);
  }
  this->Note(FormatFixed(sum, 2) + " s  in all");
}

} // namespace rhombic
