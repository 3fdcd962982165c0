#ifndef rhombicQuietLibraries_h
#define rhombicQuietLibraries_h

namespace rhombic
{

/** Turns ITK's and GDCM's messages off as long as any object of this class exists. The switches are global to the
 * process; the destructor of the last object restores them. */
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
