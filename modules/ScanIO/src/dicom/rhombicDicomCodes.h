#ifndef rhombicDicomCodes_h
#define rhombicDicomCodes_h

#include <string>

namespace rhombic
{

/** What may travel on of a header's texts. People write names and dates into fields that are not made for them, so only
 * numbers and known words stay as they are. */

/** DICOM's codes of modalities, "other" for anything else, empty for an empty text. */
std::string
ModalityOf(const std::string & text);

/** Values of ImageType: those of known words as they are; others become "other-" and four digits of their hash, which
 * tell them apart. */
std::string
ImageTypeOf(const std::string & text);

/** Numbers (IS, DS), one or several between backslashes; empty for anything else. */
std::string
NumberTextOf(const std::string & text);

/** A name that may be free text: numbers of up to four digits as they are, others as ImageTypeOf does. */
std::string
NameCodeOf(const std::string & text);

/** FNV-1a, 64 bits, in hexadecimal. */
std::string
HashOf(const std::string & text);

} // namespace rhombic

#endif
