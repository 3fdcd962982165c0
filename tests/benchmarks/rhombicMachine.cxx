#include "rhombicMachine.h"

#include "itkMultiThreaderBase.h"
#include "itkVersion.h"

#include <hwy/targets.h>
#include <vtkSMPTools.h>
#include <vtkVersion.h>

#include <fstream>
#include <string>
#include <thread>

#include <cstdlib>

namespace rhombic
{
namespace
{

std::string
GetModelOfCPU()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    const auto colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos)
    {
      return line.substr(colon + 2);
    }
  }
  return "unknown";
}

} // namespace

nlohmann::json
DescribeMachine()
{
  const auto targets = hwy::SupportedTargets();
  double load = 0.0;
  getloadavg(&load, 1);
  return { { "cpu", GetModelOfCPU() },
           { "threads", std::thread::hardware_concurrency() },
           { "simd", hwy::TargetName(targets & -targets) }, // the lowest bit is the best target
           { "compiler", __VERSION__ },
           { "itk", itk::Version::GetITKVersion() },
           { "vtk", vtkVersion::GetVTKVersion() },
           { "load", load } };
}

void
UseThreads(unsigned int threads)
{
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(threads);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(threads);
  itk::MultiThreaderBase::New()->SetMaximumNumberOfThreads(threads); // makes the pool grow
  vtkSMPTools::SetBackend(threads > 1 ? "STDThread" : "Sequential");
  vtkSMPTools::Initialize(static_cast<int>(threads));
}

} // namespace rhombic
