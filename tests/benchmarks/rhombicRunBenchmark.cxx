#include "rhombicRunBenchmark.h"

#include "rhombicFailure.h"

#include <iostream>

namespace rhombic
{

int
RunBenchmark(CLI::App & parser, int argc, char ** argv, const std::function<void()> & run)
{
  CLI11_PARSE(parser, argc, argv);
  try
  {
    run();
    return 0;
  }
  catch (const Failure & failure)
  {
    std::cerr << parser.get_name() << ": " << failure.GetDescription() << '\n';
    return static_cast<int>(failure.GetKind());
  }
  catch (const std::exception & error)
  {
    std::cerr << parser.get_name() << ": " << DescribeError(error) << '\n';
    return static_cast<int>(FailureKind::Internal);
  }
}

} // namespace rhombic
