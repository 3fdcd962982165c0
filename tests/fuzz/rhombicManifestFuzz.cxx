#include "rhombicBatchCases.h"
#include "rhombicFailure.h"
#include "rhombicFuzzProperty.h"
#include "rhombicTemporaryFolder.h"

#include <fstream>
#include <set>

using rhombicfuzz::Require;

/** Manifests of collections, beside two files that they may name: a.nii and b.nii. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const rhombictest::TemporaryFolder folder;
  std::ofstream(folder.Path() / "a.nii") << "a";
  std::ofstream(folder.Path() / "b.nii") << "b";
  const std::filesystem::path path = folder.Path() / "cases.tsv";
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
  try
  {
    const rhombic::CaseCollection collection = rhombic::FindCases(path);
    Require(!collection.cases.empty(), "a collection has cases");
    std::set<std::string> names;
    for (const rhombic::BatchCase & found : collection.cases)
    {
      Require(!found.name.empty() && names.insert(found.name).second, "cases have different names");
      Require(found.folder.is_relative() && found.folder.lexically_normal().begin()->string() != "..",
              "folders of cases are in that of the batch");
      Require(found.scan.is_absolute(), "scans have whole paths");
    }
  }
  catch (const rhombic::Failure & failure)
  {
    Require(failure.GetKind() != rhombic::FailureKind::Internal, "what is wrong is the manifest's mistake");
  }
  return 0;
}
