#include "rhombicBatchJournal.h"
#include "rhombicBatchResults.h"
#include "rhombicFuzzProperty.h"
#include "rhombicTemporaryFolder.h"

#include <fstream>

using rhombicfuzz::Require;

/** Journals of batches: each line is a record or is left out, and tables and pages can be made of the records. */
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t * data, std::size_t size)
{
  static const rhombictest::TemporaryFolder folder;
  std::ofstream(folder.Path() / "journal.jsonl", std::ios::binary)
    .write(reinterpret_cast<const char *>(data), static_cast<std::streamsize>(size));
  std::vector<rhombic::Report> records;
  for (const auto & [name, record] : rhombic::ReadJournal(folder.Path()))
  {
    Require(record.at("case") == name, "records have the name of their case");
    records.push_back(record);
  }
  rhombic::WriteResults(records, nullptr, folder.Path());
  return 0;
}
