#include "rhombicTextTable.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iomanip>
#include <ostream>
#include <sstream>

namespace rhombic
{

TextTable::TextTable(std::vector<std::string> heading)
{
  m_Rows.push_back(std::move(heading));
}

void
TextTable::Add(std::vector<std::string> row)
{
  row.resize(m_Rows.front().size());
  m_Rows.push_back(std::move(row));
}

void
TextTable::Print(std::ostream & os) const
{
  std::vector<std::size_t> widths(m_Rows.front().size());
  for (const auto & row : m_Rows)
  {
    for (std::size_t i = 0; i < widths.size(); ++i)
    {
      widths[i] = std::max(widths[i], row[i].size());
    }
  }
  for (std::size_t r = 0; r < m_Rows.size(); ++r)
  {
    for (std::size_t i = 0; i < widths.size(); ++i)
    {
      // The first row decides on a column's alignment.
      const std::string & example = m_Rows[m_Rows.size() > 1 ? 1 : 0][i];
      const bool isNumber = !example.empty() && std::isdigit(static_cast<unsigned char>(example.front())) != 0;
      os << (i > 0 ? "  " : "") << (isNumber ? std::right : std::left) << std::setw(static_cast<int>(widths[i]))
         << m_Rows[r][i];
    }
    os << '\n';
    if (r == 0)
    {
      for (std::size_t i = 0; i < widths.size(); ++i)
      {
        os << (i > 0 ? "  " : "") << std::string(widths[i], '-');
      }
      os << '\n';
    }
  }
  os << std::left;
}

std::string
Fixed(double value, int digits)
{
  if (std::isnan(value))
  {
    return "-";
  }
  std::ostringstream os;
  os << std::fixed << std::setprecision(digits) << value;
  return os.str();
}

} // namespace rhombic
