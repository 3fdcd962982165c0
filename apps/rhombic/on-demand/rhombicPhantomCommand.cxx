#include "rhombicCommands.h"
#include "rhombicFailure.h"
#include "rhombicPhantom.h"

namespace rhombic
{
namespace
{

struct PhantomOptions
{
  std::string folder;
  PhantomSettings settings;
};

void
MakePhantom(const PhantomOptions & options, const CommandContext & context)
{
  if (options.folder.empty())
  {
    throw Failure(FailureKind::Usage, "No folder is named; give a new one with -o, for example -o phantom.");
  }
  WritePhantom(options.folder, options.settings);
  context.console->Note("phantom: " + options.folder +
                        " (a DICOM series, the same as NIfTI, its labels and organ table)");
}

} // namespace

CommandRun
AddPhantomCommand(CommandSettings & command)
{
  static const SettingsTable<PhantomOptions> table{
    { "-o,--output", &PhantomOptions::folder, "a folder that is new or empty", OfKind(SettingKind::Output) },
    { "--spacing", &PhantomOptions::settings, &PhantomSettings::spacing, "voxel size in mm", ShowingDefault },
  };
  const auto options = std::make_shared<PhantomOptions>();
  command.Add(table, *options);
  return WithoutOutputs([options](const CommandContext & context) { MakePhantom(*options, context); });
}

} // namespace rhombic
