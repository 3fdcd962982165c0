# Fails if Doxygen warned, or took a macro of ITK's or VTK's for a function: modules/Documentation.cmake tells it what they make.
# Classes, functions and enumerations must be documented; left out are functions that ITK's conventions or the standard
# library's name (overrides, constructors, operators, New(), what containers and allocators have), accessors and
# predicates (Get, Is, Has), aliases and variables.
# cmake -DREFERENCE=<Doxygen's output folder> -P check-reference.cmake

set(conventions "New|SetInput|GetInput|GetOutput|begin|end|size|allocate|deallocate|construct")

file(STRINGS "${REFERENCE}/warnings.txt" warnings)
set(wrong "")
foreach(warning IN LISTS warnings)
  if(warning MATCHES " is not documented" AND
     (warning MATCHES "\\((typedef|variable|friend)\\)| override |Member operator" OR
      warning MATCHES "Member ((${conventions})\\(|(Get|Is|Has)[A-Za-z]+\\(|[A-Za-z]+(On|Off)\\(\\))"))
    continue()
  endif()
  string(REGEX MATCH "Member ([A-Za-z]+)\\(.* (class|struct) [A-Za-z:]+::([A-Za-z]+) is not" constructor "${warning}")
  if(NOT constructor OR NOT CMAKE_MATCH_1 STREQUAL CMAKE_MATCH_3)
    string(APPEND wrong "\n  ${warning}")
  endif()
endforeach()

file(GLOB pages "${REFERENCE}/html/functions*.html" "${REFERENCE}/html/namespacemembers*.html")
if(NOT pages)
  message(FATAL_ERROR "There is no reference in ${REFERENCE}")
endif()
set(macros "")
foreach(page IN LISTS pages)
  file(READ "${page}" text)
  string(REGEX MATCHALL "(itk|vtk)[A-Za-z]+Macro" names "${text}")
  list(APPEND macros ${names})
endforeach()
list(REMOVE_DUPLICATES macros)
foreach(macro IN LISTS macros)
  string(APPEND wrong "\n  ${macro} is shown as a function")
endforeach()
if(NOT wrong STREQUAL "")
  message(FATAL_ERROR "The reference is not as it should be:${wrong}")
endif()
