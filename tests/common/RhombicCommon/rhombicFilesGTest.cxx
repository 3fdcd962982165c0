#include "rhombicFailure.h"
#include "rhombicFiles.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

namespace
{

TEST(TextFile, WhatTheSystemCanNotReadToItsEndIsRefused)
{
  const std::filesystem::path broken = "/proc/self/mem"; // a regular file, whose first bytes are an error
  if (!std::filesystem::exists(broken))
  {
    GTEST_SKIP() << broken << " is not there";
  }
  try
  {
    rhombic::ReadTextFile(broken, "table");
    FAIL() << "it was read";
  }
  catch (const rhombic::Failure & failure)
  {
    EXPECT_EQ(failure.GetKind(), rhombic::FailureKind::Unreadable);
    EXPECT_NE(std::string(failure.GetDescription()).find("to its end"), std::string::npos) << failure.GetDescription();
  }
}

TEST(HashFiles, FilesThatCanNotBeReadAreRefused)
{
  EXPECT_EQ(rhombic::HashFiles({}), "d41d8cd98f00b204e9800998ecf8427e"); // of no bytes (RFC 1321)
  EXPECT_THROW(rhombic::HashFiles({ "/proc/self/cmdline", "/no/such/file" }), rhombic::Failure);
  EXPECT_THROW(rhombic::HashFiles({ "/proc/self/mem" }), rhombic::Failure); // whose first bytes are an error
}

} // namespace
