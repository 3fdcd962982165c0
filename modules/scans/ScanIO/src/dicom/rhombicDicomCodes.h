#ifndef rhombicDicomCodes_h
#define rhombicDicomCodes_h

#include <string>

namespace rhombic
{

/** \file
 * Header texts without personal data. People write names and dates into any field, so only numbers and known words are
 * kept. */

/** DICOM's codes of modalities, "other" for anything else, empty for an empty text. */
std::string
ModalityOf(const std::string & text);

/** Values of ImageType: values of known words are kept; others become "other-" and four digits of their hash. */
std::string
ImageTypeOf(const std::string & text);

/** Numbers (IS, DS), one or several between backslashes; empty for anything else. */
std::string
NumberTextOf(const std::string & text);

/** A name that may be free text: numbers of up to four digits are kept; others become "other-" and four digits of their
 * hash. */
std::string
NameCodeOf(const std::string & text);

/** DICOM's terms of body parts; empty for anything else. */
std::string
BodyPartOf(const std::string & text);

/** The units of a PET's values in words, by DICOM's terms; empty for anything else. */
std::string
UnitsOf(const std::string & text);

} // namespace rhombic

#endif
