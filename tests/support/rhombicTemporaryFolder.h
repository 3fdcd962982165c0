#ifndef rhombicTemporaryFolder_h
#define rhombicTemporaryFolder_h

#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace rhombictest
{

/** A new empty folder that goes away with the object. */
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string pattern = (std::filesystem::temp_directory_path() / "rhombic-test-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr)
    {
      throw std::runtime_error("mkdtemp failed for " + pattern);
    }
    m_Path = pattern;
  }
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(m_Path, ignored);
  }
  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &
  operator=(const TemporaryFolder &) = delete;

  const std::filesystem::path &
  Path() const
  {
    return m_Path;
  }

private:
  std::filesystem::path m_Path;
};

} // namespace rhombictest

#endif
