#include "rhombicTextFile.h"

#include "rhombicFailure.h"

#include <algorithm>
#include <fstream>

namespace rhombic
{

std::string
ReadTextFile(const std::filesystem::path & path, const std::string & kind, std::size_t most)
{
  std::error_code error;
  if (!std::filesystem::exists(path, error))
  {
    throw Failure(FailureKind::NotFound, "There is no " + kind + " " + path.string() + "; check the path.");
  }
  std::ifstream file;
  if (std::filesystem::is_regular_file(path, error)) // opening a pipe would wait for its other end
  {
    file.open(path, std::ios::binary);
  }
  if (!file.is_open())
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + path.string() + ": it is no file, or not yours to read; name a " + kind + ".");
  }
  std::string text;
  std::string block(std::size_t{ 1 } << 16, '\0');
  while (text.size() <= most && file.read(block.data(), static_cast<std::streamsize>(block.size())).gcount() > 0)
  {
    text.append(block, 0, static_cast<std::size_t>(file.gcount()));
  }
  text.erase(0, text.size() - WithoutByteOrderMark(text, path.string()).size());
  text.resize(std::min(text.size(), most) + (text.size() > most ? 1 : 0));
  return text;
}

std::string_view
WithoutByteOrderMark(std::string_view text, const std::string & source)
{
  const std::string_view begin = text.substr(0, 2);
  if (begin == "\xFF\xFE" || begin == "\xFE\xFF")
  {
    throw Failure(FailureKind::Unreadable,
                  "Cannot read " + source +
                    ": it is text in UTF-16; save it as UTF-8, as spreadsheets do with "
                    "'CSV UTF-8'.");
  }
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.substr(0, mark.size()) == mark ? text.substr(mark.size()) : text;
}

} // namespace rhombic
