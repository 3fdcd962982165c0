#ifndef rhombicFailure_h
#define rhombicFailure_h

#include "itkMacro.h"

#include <string>

/** \namespace rhombic
 * \brief Scans, files, pictures and pipelines: everything that is not an ITK class. */
namespace rhombic
{

/** The kind of a failure. Its value is the exit code of the `rhombic` program. */
enum class FailureKind : int
{
  Internal = 1,      ///< a defect in Rhombic or a library under it
  Usage = 2,         ///< an option, preset or combination that makes no sense
  NotFound = 3,      ///< no such file or folder, or no scan in it
  Unreadable = 4,    ///< the input is damaged, or of a kind that is not supported
  Geometry = 5,      ///< the input's position in the patient can't be known
  Empty = 6,         ///< there is no surface at this isovalue
  Output = 7,        ///< the output can't be written
  NotWatertight = 8, ///< a surface has holes or other defects, and should have none
  Memory = 9,        ///< there is, or would be, too little memory
  Display = 10,      ///< no way to draw on this machine
  Different = 11,    ///< pictures differ by more than the tolerance
  SomeFailed = 12    ///< some cases of a batch failed
};

/** \class Failure
 * \brief The exception of every Rhombic module outside `namespace itk`.
 *
 * The description is one sentence for the user: what failed, where, and one thing to try. It derives from
 * itk::ExceptionObject, so a host that catches ITK's exceptions catches it too. Its file, line and location are those
 * of the call of its constructor.
 */
class Failure : public itk::ExceptionObject
{
public:
  Failure(FailureKind kind,
          const std::string & description,
          const char * file = __builtin_FILE(),
          unsigned int line = __builtin_LINE(),
          const char * location = __builtin_FUNCTION());

  FailureKind
  GetKind() const
  {
    return m_Kind;
  }

  const char *
  GetNameOfClass() const override
  {
    return "Failure";
  }

private:
  FailureKind m_Kind;
};

/** The message of a library's exception as part of a sentence: its first line, without the class and address of the
 * object that threw, which ITK puts first. */
std::string
DescribeError(const std::exception & error);

} // namespace rhombic

#endif
