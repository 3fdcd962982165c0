#ifndef rhombicVTPNumbers_h
#define rhombicVTPNumbers_h

#include "rhombicVTPDocument.h"

#include <optional>
#include <string_view>

namespace rhombic
{

/** \class VTPNumbers
 * \brief The numbers of an array one after the other, whatever their type and encoding; of strings, their bytes. */
class VTPNumbers
{
public:
  /** The document must live as long. Throws Failure(Unreadable) when the array's bytes are not there or damaged. */
  VTPNumbers(const InputFile & file, const VTPDocument & document, const VTPArray & array);

  /** How many are left; of text, at most so many. */
  std::uint64_t
  GetRest() const;

  bool
  HasMore() const;

  /** Throws Failure(Unreadable) at the end. */
  double
  Take();

  /** The same for one that must be whole and not negative. */
  std::uint64_t
  TakeWhole();

private:
  enum class Type
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

  static Type
  ParseType(const InputFile & file, const VTPArray & array);

  std::size_t
  GetTypeSize() const;

  template <typename TNumber>
  double
  TakeBinary();

  const InputFile & m_File;
  Type m_Type;
  bool m_IsBigEndian;
  bool m_IsText;
  std::string_view m_Text;             ///< what is left of it
  std::optional<InputStream> m_Stream; ///< of bytes that lie in the file as they are
  std::string m_Bytes;                 ///< those that had to be decoded
  std::size_t m_Taken = 0;
};

} // namespace rhombic

#endif
