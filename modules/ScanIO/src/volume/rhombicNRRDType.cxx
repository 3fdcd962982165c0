#include "rhombicNRRDType.h"

#include "rhombicWording.h"

#include <algorithm>
#include <vector>

namespace rhombic
{

std::string
CanonicalNRRDType(const std::string & name)
{
  static const std::vector<std::vector<std::string>> types{
    { "int8", "int8_t", "signed char" },
    { "uint8", "uint8_t", "uchar", "unsigned char" },
    { "int16", "int16_t", "short", "short int", "signed short", "signed short int" },
    { "uint16", "uint16_t", "ushort", "unsigned short", "unsigned short int" },
    { "int32", "int32_t", "int", "signed int" },
    { "uint32", "uint32_t", "uint", "unsigned int" },
    { "int64", "int64_t", "longlong", "long long", "long long int", "signed long long", "signed long long int" },
    { "uint64", "uint64_t", "ulonglong", "unsigned long long", "unsigned long long int" },
    { "float" },
    { "double" },
  };
  const std::string lowerCase = LowerCase(name);
  for (const auto & names : types)
  {
    if (std::find(names.begin(), names.end(), lowerCase) != names.end())
    {
      return names.front();
    }
  }
  return {};
}

} // namespace rhombic
