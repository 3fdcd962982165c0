#ifndef rhombicGermanNumbers_h
#define rhombicGermanNumbers_h

#include <locale>
#include <string>

namespace rhombictest
{

/** Decimal commas and grouped thousands, as German has them, without that locale installed. */
class GermanNumbers : public std::numpunct<char>
{
protected:
  char
  do_decimal_point() const override
  {
    return ',';
  }
  char
  do_thousands_sep() const override
  {
    return '.';
  }
  std::string
  do_grouping() const override
  {
    return "\3";
  }
};

} // namespace rhombictest

#endif
