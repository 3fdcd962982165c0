#include "rhombicCommands.h"

#include <map>
#include <string>

/** The function of this library that rhombic calls: adds the settings of a command to \a command and gives what runs
 * it. \a command must be one of this folder's. */
extern "C" void
rhombicAddOnDemandCommand(rhombic::CommandSettings & command, rhombic::CommandRun & run)
{
  using namespace rhombic;
  static const std::map<std::string, CommandRun (*)(CommandSettings &)> commands{
    { "render", AddRenderCommand },
    { "compare-labels", AddCompareLabelsCommand },
    { "compare-pictures", AddComparePicturesCommand },
    { "compare", AddCompareCommand },
    { "phantom", AddPhantomCommand },
    { "doctor", AddDoctorCommand },
  };
  run = commands.at(command.GetCommand())(command);
}
