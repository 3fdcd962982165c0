#ifndef rhombicFuzzBytes_h
#define rhombicFuzzBytes_h

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string_view>

namespace rhombicfuzz
{

/** \class FuzzBytes
 * \brief Takes numbers from a fuzzer's input; zeros behind its end. */
class FuzzBytes
{
public:
  FuzzBytes(const std::uint8_t * data, std::size_t size)
    : m_Rest(reinterpret_cast<const char *>(data), size)
  {}

  template <typename TNumber>
  TNumber
  Take()
  {
    TNumber number{};
    const std::size_t count = std::min(sizeof(number), m_Rest.size());
    if (count > 0)
    {
      std::memcpy(&number, m_Rest.data(), count);
    }
    m_Rest.remove_prefix(count);
    return number;
  }

  std::size_t
  TakeBelow(std::size_t end)
  {
    return this->Take<std::uint8_t>() % end;
  }

  /** Mostly \a usual, else one of the numbers that arithmetic fails on, or any. */
  double
  TakeNumber(double usual)
  {
    using Limits = std::numeric_limits<double>;
    constexpr double awkward[]{ 0,
                                -0.0,
                                1,
                                -1,
                                1e-3,
                                1e-9,
                                1e9,
                                1e154,
                                -1e154,
                                1e308,
                                -1e308,
                                1e-308,
                                1e-160,
                                0.05,
                                Limits::infinity(),
                                -Limits::infinity(),
                                Limits::quiet_NaN(),
                                Limits::denorm_min(),
                                Limits::max(),
                                Limits::lowest() };
    constexpr std::size_t count = sizeof(awkward) / sizeof(*awkward);
    const auto choice = this->Take<std::uint8_t>();
    if (choice < 192)
    {
      return usual;
    }
    return choice < 192 + count ? awkward[choice - 192]
           : choice < 236       ? usual + 0.01 * (choice - 224)
                                : this->Take<double>();
  }

  std::string_view
  Rest() const
  {
    return m_Rest;
  }

private:
  std::string_view m_Rest;
};

} // namespace rhombicfuzz

#endif
