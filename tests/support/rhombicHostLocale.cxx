// Preloaded into a program (LD_PRELOAD), it sets the user's locale for C and for C++, as graphical programs do that use
// our libraries.

#include <clocale>
#include <locale>

static const bool IsSet = [] {
  std::setlocale(LC_ALL, "");
  std::locale::global(std::locale(""));
  return true;
}();
