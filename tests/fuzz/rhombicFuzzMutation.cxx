#include "rhombicFuzzMutation.h"

#include <algorithm>

namespace rhombicfuzz
{
namespace
{

/** A number that length fields and counters stumble over, in 1, 2, 4 or 8 bytes of either order. */
std::string
AwkwardInteger(FuzzRandom & random)
{
  constexpr std::uint64_t numbers[]{ 0,
                                     1,
                                     2,
                                     7,
                                     8,
                                     0x7f,
                                     0x80,
                                     0xff,
                                     0x100,
                                     0x7fff,
                                     0x8000,
                                     0xfffe,
                                     0xffff,
                                     0x10000,
                                     0x7fffffff,
                                     0x80000000,
                                     0xfffffffe,
                                     0xffffffff,
                                     0x7fffffffffffffff,
                                     ~std::uint64_t{} };
  const std::uint64_t number = numbers[random.Below(std::size(numbers))];
  std::string bytes;
  for (std::size_t n = 0; n < std::size_t{ 1 } << random.Below(4); ++n)
  {
    bytes += static_cast<char>(number >> 8 * n);
  }
  if (random.Below(4) == 0)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  return bytes;
}

void
MutateOnce(std::string & bytes, const std::string & other, FuzzRandom & random)
{
  const std::size_t place = random.Below(bytes.size() + 1);
  const std::size_t length = random.Below(random.Below(8) == 0 ? bytes.size() + 1 : 16);
  switch (random.Below(8))
  {
    case 0:
      bytes.resize(place);
      break;
    case 1:
      bytes.erase(place, length);
      break;
    case 2:
      bytes.insert(place, AwkwardInteger(random));
      break;
    case 3:
    {
      const std::string number = AwkwardInteger(random);
      bytes.replace(place, number.size(), number);
      break;
    }
    case 4:
    {
      const std::size_t begin = random.Below(other.size() + 1);
      bytes.replace(place, length, other, begin, random.Below(random.Below(4) == 0 ? other.size() + 1 : 64));
      break;
    }
    case 5:
      bytes.insert(place, bytes.substr(random.Below(bytes.size() + 1), length));
      break;
    default:
      if (place < bytes.size())
      {
        bytes[place] = static_cast<char>(bytes[place] ^ (1 << random.Below(8)));
      }
  }
}

} // namespace

FuzzRandom::FuzzRandom(std::uint64_t seed)
  : m_State(seed * 0x9e3779b97f4a7c15u + 1)
{}

std::uint64_t
FuzzRandom::Next()
{
  m_State ^= m_State << 13;
  m_State ^= m_State >> 7;
  m_State ^= m_State << 17;
  return m_State;
}

std::size_t
FuzzRandom::Below(std::size_t end)
{
  return static_cast<std::size_t>(this->Next() >> 11) % end;
}

std::string
Mutate(const std::vector<std::string> & seeds, FuzzRandom & random)
{
  std::string bytes = seeds[random.Below(seeds.size())];
  for (std::size_t count = 1 + random.Below(8); count > 0; --count)
  {
    MutateOnce(bytes, seeds[random.Below(seeds.size())], random);
  }
  return bytes;
}

} // namespace rhombicfuzz
