#ifndef rhombicWording_h
#define rhombicWording_h

#include <cstdint>
#include <string>
#include <vector>

namespace rhombic
{

/** \file
 * Parts of sentences for users. Thread safety: any number of threads may call these functions at once. */

/** "1 label", "2 labels". \a plural is the noun with an s when it is empty. */
std::string
Count(std::uintmax_t number, const std::string & noun, const std::string & plural = {});

/** "lean, fine or octahedra", with \a conjunction before the last word. */
std::string
Enumerate(const std::vector<std::string> & words, const std::string & conjunction = "or");

/** The one of \a names that \a word was probably meant to be: a third of its letters at most is wrong, missing, too
 * much or exchanged, or one of the two, of three letters or more, is a part of the other. Upper and lower case are the
 * same. Empty when there is none. */
std::string
NearestName(const std::string & word, const std::vector<std::string> & names);

/** "There is no mode 'leen'; did you mean lean? Otherwise use lean or fine." \a what is a noun, \a advice what to do
 * when no name is near. */
std::string
DescribeUnknown(const std::string & what,
                const std::string & word,
                const std::vector<std::string> & names,
                const std::string & advice);

} // namespace rhombic

#endif
