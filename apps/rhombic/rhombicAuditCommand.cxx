#include "rhombicSurfaceReport.h"
#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicSurfaceIO.h"
#include "rhombicWording.h"

#include <iostream>

namespace rhombic
{
namespace
{

struct AuditOptions
{
  std::vector<std::string> files;
  bool isJson = false;
  bool requiresWatertight = true;
  std::size_t maximumTested = itk::TriangleSurfaceAuditSettings().maximumTestedTriangles;
};

/** \class Auditor
 * \brief Audits surfaces, and prints or collects the results. */
class Auditor
{
public:
  Auditor(const AuditOptions & options, const CommandContext & context)
    : m_Options(options)
    , m_Context(context)
    , m_Events(context.console->MakeEvents())
  {
    m_Settings.testsIntersections = options.maximumTested > 0;
    m_Settings.maximumTestedTriangles = options.maximumTested;
  }

  void
  Run()
  {
    std::vector<SceneSurface> surfaces;
    for (const std::string & file : m_Options.files)
    {
      m_Events.Progress("reading", 0.0);
      for (const SceneSurface & surface : ReadSurfaces(file))
      {
        this->AuditOne(surface);
        surfaces.push_back(surface);
      }
    }
    if (surfaces.size() > 1)
    {
      this->AuditTogether(surfaces);
    }
    m_Context.console->Finish();
    if (m_Options.isJson)
    {
      std::cout << ToJson(m_Report) << '\n';
    }
    if (!m_Leaking.empty())
    {
      throw Failure(FailureKind::NotWatertight,
                    Enumerate(m_Options.files, "and") + (m_Options.files.size() > 1 ? " are" : " is") +
                      " not watertight: " + m_Leaking + ".");
    }
  }

private:
  void
  AuditOne(const SceneSurface & surface)
  {
    m_Events.Progress("auditing " + surface.name, 0.0);
    const auto audit = AuditTriangleSurface(*surface.surface, m_Settings);
    this->Add(surface.name, ReportAudit(audit), DescribeAudit(audit));
    if (!audit.IsWatertight())
    {
      this->AddLeak(surface.name + ": " + DescribeLeaks(audit));
    }
  }

  /** Audits the walls that surfaces share, if they do. */
  void
  AuditTogether(const std::vector<SceneSurface> & surfaces)
  {
    m_Events.Progress("auditing walls", 0.0);
    const WallAudit walls = AuditWalls(surfaces, m_Settings);
    if (walls.sharedTriangles == 0)
    {
      return;
    }
    this->Add("all surfaces together", { { "walls", ReportWalls(walls) } }, { DescribeWalls(walls) });
    if (!walls.IsClosed())
    {
      this->AddLeak("walls: " + DescribeWalls(walls));
    }
  }

  void
  Add(const std::string & name, const Report & report, const std::vector<std::string> & lines)
  {
    m_Report.push_back({ { "name", name } });
    m_Report.back().update(report);
    if (!m_Options.isJson)
    {
      m_Context.console->Finish();
      std::cout << name << '\n';
      for (const std::string & line : lines)
      {
        std::cout << "  " << line << '\n';
      }
    }
  }

  void
  AddLeak(const std::string & leak)
  {
    m_Leaking += (m_Leaking.empty() ? "" : "; ") + leak;
  }

  const AuditOptions & m_Options;
  const CommandContext & m_Context;
  Events m_Events;
  itk::TriangleSurfaceAuditSettings m_Settings;
  Report m_Report = Report::array();
  std::string m_Leaking;
};

} // namespace

CommandRun
AddAuditCommand(CommandSettings & command)
{
  static const SettingsTable<AuditOptions> table{
    { "FILE",
      &AuditOptions::files,
      "surface files, checked one by one and together: " + GetSurfaceFileExtensions(),
      OfKind(SettingKind::Source) },
    { "--json", &AuditOptions::isJson, "write a JSON report" },
    { "--require-watertight", // of scripts from before this was always required
      &AuditOptions::requiresWatertight,
      "",
      Hidden },
    { "--max-tested",
      &AuditOptions::maximumTested,
      "triangles tested for self-intersections; of larger surfaces, so many evenly chosen ones; 0: none",
      NotBelowZero,
      ShowingDefault },
  };
  const auto options = std::make_shared<AuditOptions>();
  command.Add(table, *options);
  return WithoutOutputs([options](const CommandContext & context) {
    if (options->files.empty())
    {
      throw Failure(FailureKind::Usage, "No surface is named; name a file (" + GetSurfaceFileExtensions() + ").");
    }
    Auditor(*options, context).Run();
  });
}

} // namespace rhombic
