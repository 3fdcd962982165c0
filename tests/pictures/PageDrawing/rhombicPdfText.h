#ifndef rhombicPdfText_h
#define rhombicPdfText_h

#include "rhombicTemporaryFolder.h"

#include <cstdio>
#include <fstream>
#include <optional>
#include <string>

namespace rhombictest
{

/** The text of a PDF, by pdftotext of poppler-utils. Nothing when it is not installed. */
inline std::optional<std::string>
TextOfPdf(const std::string & bytes)
{
  const TemporaryFolder folder;
  const std::string file = (folder.Path() / "page.pdf").string();
  std::ofstream(file, std::ios::binary) << bytes;
  std::FILE * const pipe = popen(("pdftotext -layout '" + file + "' - 2>/dev/null").c_str(), "r");
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
  {
    text += static_cast<char>(c);
  }
  return pclose(pipe) == 0 ? std::optional<std::string>(text) : std::nullopt;
}

inline std::size_t
CountIn(const std::string & text, const std::string & part)
{
  std::size_t count = 0;
  for (auto i = text.find(part); i != std::string::npos; i = text.find(part, i + part.size()))
  {
    ++count;
  }
  return count;
}

} // namespace rhombictest

#endif
