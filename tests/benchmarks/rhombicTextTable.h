#ifndef rhombicTextTable_h
#define rhombicTextTable_h

#include <iosfwd>
#include <string>
#include <vector>

namespace rhombic
{

/** \class TextTable
 * \brief Rows of words under a heading, printed in columns as wide as their widest word; numbers are aligned right. */
class TextTable
{
public:
  explicit TextTable(std::vector<std::string> heading);

  /** Adds a row. If it has fewer words than the heading, the last columns stay empty. */
  void
  Add(std::vector<std::string> row);

  void
  Print(std::ostream & os) const;

private:
  std::vector<std::vector<std::string>> m_Rows;
};

/** A number with the given digits after the point; "-" if it is not a number. */
std::string
Fixed(double value, int digits);

} // namespace rhombic

#endif
