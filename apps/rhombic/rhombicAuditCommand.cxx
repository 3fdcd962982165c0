#include "rhombicAuditReport.h"
#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicSurfaceIO.h"

#include <iostream>

namespace rhombic
{
namespace
{

struct AuditOptions
{
  std::string file;
  bool isJson = false;
  bool requiresWatertight = false;
  std::size_t maximumTested = itk::TriangleSurfaceAuditSettings().maximumTestedTriangles;
};

void
Audit(const AuditOptions & options, const CommandContext & context)
{
  if (options.file.empty())
  {
    throw Failure(FailureKind::Usage, "No surface is named; name a file (" + GetSurfaceFileExtensions() + ").");
  }
  const Events events = context.console->MakeEvents();
  events.Progress("reading", 0.0);
  itk::TriangleSurfaceAuditSettings settings;
  settings.testsIntersections = options.maximumTested > 0;
  settings.maximumTestedTriangles = options.maximumTested;
  Report report = Report::array();
  std::string leaking;
  for (const SceneSurface & surface : ReadSurfaces(options.file, { GetVTPConverter(), context.decoder }))
  {
    events.Progress("auditing " + surface.name, 0.0);
    const auto audit = AuditSurface(*surface.surface, settings);
    report.push_back({ { "name", surface.name } });
    report.back().update(ReportAudit(audit));
    if (!audit.IsWatertight())
    {
      leaking += (leaking.empty() ? "" : "; ") + surface.name + ": " + DescribeLeaks(audit);
    }
    if (!options.isJson)
    {
      context.console->Finish();
      std::cout << surface.name << '\n';
      for (const std::string & line : DescribeAudit(audit))
      {
        std::cout << "  " << line << '\n';
      }
    }
  }
  context.console->Finish();
  if (options.isJson)
  {
    std::cout << ToJson(report) << '\n';
  }
  if (options.requiresWatertight && !leaking.empty())
  {
    throw Failure(FailureKind::NotWatertight, options.file + " is not watertight: " + leaking + ".");
  }
}

} // namespace

CommandRun
AddAuditCommand(CLI::App & parser)
{
  const auto options = std::make_shared<AuditOptions>();
  parser.add_option("FILE", options->file, "a surface file: " + GetSurfaceFileExtensions());
  parser.add_flag("--json", options->isJson, "write a JSON report");
  parser.add_flag(
    "--require-watertight", options->requiresWatertight, "exit code 8 unless every surface is watertight");
  parser
    .add_option("--max-tested",
                options->maximumTested,
                "triangles tested for self-intersections; of larger surfaces, so many evenly chosen ones; 0: none")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  return [options](const CommandContext & context) { Audit(*options, context); };
}

} // namespace rhombic
