#ifndef rhombicQuietLibraries_h
#define rhombicQuietLibraries_h

namespace rhombic
{

/** Keeps ITK's and GDCM's messages off the terminal as long as any object of this class lives. The switches are global
 * to the process; the last object to go sets them back. Thread safe. */
class QuietLibraries
{
public:
  QuietLibraries();
  ~QuietLibraries();

  QuietLibraries(const QuietLibraries &) = delete;
  QuietLibraries &
  operator=(const QuietLibraries &) = delete;
};

} // namespace rhombic

#endif
