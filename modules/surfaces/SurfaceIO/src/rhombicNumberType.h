#ifndef rhombicNumberType_h
#define rhombicNumberType_h

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

namespace rhombic
{

/** The types of numbers in PLY and VTP files. */
enum class NumberType
{
  Int8,
  UInt8,
  Int16,
  UInt16,
  Int32,
  UInt32,
  Int64,
  UInt64,
  Float32,
  Float64
};

inline std::size_t
SizeOf(NumberType type)
{
  constexpr std::size_t sizes[]{ 1, 1, 2, 2, 4, 4, 8, 8, 4, 8 };
  return sizes[static_cast<std::size_t>(type)];
}

template <typename TNumber, typename TTakeBytes>
double
TakeNumberAs(bool isBigEndian, const TTakeBytes & takeBytes)
{
  std::array<char, sizeof(TNumber)> bytes;
  takeBytes(bytes.data(), bytes.size());
  if (isBigEndian)
  {
    std::reverse(bytes.begin(), bytes.end());
  }
  TNumber number;
  std::memcpy(&number, bytes.data(), bytes.size());
  return static_cast<double>(number);
}

/** Decodes the next number; \a takeBytes(to, size) gets its bytes. */
template <typename TTakeBytes>
double
TakeNumber(NumberType type, bool isBigEndian, const TTakeBytes & takeBytes)
{
  switch (type)
  {
    case NumberType::Int8:
      return TakeNumberAs<std::int8_t>(isBigEndian, takeBytes);
    case NumberType::UInt8:
      return TakeNumberAs<std::uint8_t>(isBigEndian, takeBytes);
    case NumberType::Int16:
      return TakeNumberAs<std::int16_t>(isBigEndian, takeBytes);
    case NumberType::UInt16:
      return TakeNumberAs<std::uint16_t>(isBigEndian, takeBytes);
    case NumberType::Int32:
      return TakeNumberAs<std::int32_t>(isBigEndian, takeBytes);
    case NumberType::UInt32:
      return TakeNumberAs<std::uint32_t>(isBigEndian, takeBytes);
    case NumberType::Int64:
      return TakeNumberAs<std::int64_t>(isBigEndian, takeBytes);
    case NumberType::UInt64:
      return TakeNumberAs<std::uint64_t>(isBigEndian, takeBytes);
    case NumberType::Float32:
      return TakeNumberAs<float>(isBigEndian, takeBytes);
    default:
      return TakeNumberAs<double>(isBigEndian, takeBytes);
  }
}

} // namespace rhombic

#endif
