# Fails unless the public headers tell in Doxygen comments what threads may do: "Thread safety: ...", "Thread safe." or
# the like, "not thread safe" included. The \file comment of a header can tell it for all that is in the header.
# Without that, it has to stand in each \class comment, and in the comment right before each class or struct that is
# defined at the start of a line; in any comment, where a header defines none.
# cmake -DSOURCE=<top folder> -P check-headers.cmake

file(GLOB headers RELATIVE "${SOURCE}" "${SOURCE}/modules/*/include/*.h" "${SOURCE}/pipelines/include/*.h")
if(NOT headers)
  message(FATAL_ERROR "There are no headers in ${SOURCE}")
endif()
string(ASCII 1 open)  # a Doxygen comment begins
string(ASCII 2 close) # any other comment, or the end of one
string(ASCII 3 semicolon)
set(comment "${open}[^${close}]*${close}")
set(definition "(class|struct) [^${semicolon}{]*{")
set(tells "[Tt]hread safe([ .,]|ty: [^ ])")

set(silent "")
foreach(header IN LISTS headers)
  file(READ "${SOURCE}/${header}" text)
  string(REPLACE ";" "${semicolon}" text "${text}") # lists must not split here, nor at unpaired brackets
  string(REGEX REPLACE "[][]" " " text "${text}")
  string(REPLACE "/**" "${open}" text "${text}")
  string(REPLACE "*/" "${close}" text "${text}")
  string(REGEX REPLACE "\n +\\* +" " " text "${text}") # each sentence of a comment on one line

  string(REGEX MATCHALL "${open}[^${close}]*\\\\file[^${close}]*${close}" file_comment "${text}")
  if(file_comment MATCHES "${tells}")
    continue()
  endif()
  string(REGEX MATCHALL "${open}[^${close}]*\\\\class [^${close}]*${close}" parts "${text}")
  string(REGEX MATCHALL "(${comment})?\n(template <[^${semicolon}{]*>\n)?${definition}" definitions "${text}")
  list(APPEND parts ${definitions})
  if(NOT parts)
    string(REGEX MATCHALL "${comment}" parts "${text}")
    string(REPLACE ";" " " parts "${parts}") # one of them is enough
    if(NOT parts)
      set(parts "nothing")
    endif()
  endif()
  foreach(part IN LISTS parts)
    if(NOT part MATCHES "${tells}")
      string(REGEX MATCH "(class|struct) (ITK_TEMPLATE_EXPORT )?[A-Za-z0-9]+" name "${part}")
      list(APPEND silent "\n  ${header} ${name}")
    endif()
  endforeach()
endforeach()
if(silent)
  list(REMOVE_DUPLICATES silent)
  list(JOIN silent "" silent)
  message(FATAL_ERROR "These public headers do not say whether they are thread safe:${silent}")
endif()
