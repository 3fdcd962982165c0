#ifndef rhombicVTPNumbers_h
#define rhombicVTPNumbers_h

#include "rhombicNumberType.h"
#include "rhombicVTPDocument.h"

#include <optional>
#include <string_view>

namespace rhombic
{

/** \class VTPNumbers
 * \brief Reads the numbers of an array in order, in any type and encoding; strings are read as bytes. */
class VTPNumbers
{
public:
  /** Keeps references to the file and the document. Throws Failure(Unreadable) if the array's bytes are missing or
   * damaged. */
  VTPNumbers(const InputFile & file, const VTPDocument & document, const VTPArray & array);

  /** The number of numbers that are left; for text, an upper bound. */
  std::uint64_t
  GetRest() const;

  bool
  HasMore() const;

  /** Throws Failure(Unreadable) at the end. */
  double
  Take();

  /** As Take(), for a number that must be whole and not negative. */
  std::uint64_t
  TakeWhole();

private:
  static NumberType
  ParseType(const InputFile & file, const VTPArray & array);

  void
  TakeBytes(char * to, std::size_t size);

  const InputFile & m_File;
  NumberType m_Type;
  bool m_IsBigEndian;
  bool m_IsText;
  std::string_view m_Text;             ///< rest of the text
  std::optional<InputStream> m_Stream; ///< if the bytes are raw in the file
  std::string m_Bytes;                 ///< the decoded bytes otherwise
  std::size_t m_Taken = 0;
};

} // namespace rhombic

#endif
