#ifndef itkClang_h
#define itkClang_h

// Included before everything else by the preset `fuzz`: Debian's ITK asks what the compiler is and refuses all but GCC,
// though clang compiles it.

#if __has_include("itk_compiler_detection.h")
#  pragma push_macro("__clang__")
#  pragma push_macro("__GNUC__")
#  undef __clang__
#  undef __GNUC__
#  define __GNUC__ 12
#  include "itk_compiler_detection.h" // IWYU pragma: keep
#  pragma pop_macro("__GNUC__")
#  pragma pop_macro("__clang__")
#endif

#endif
