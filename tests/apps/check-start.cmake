# Fails if rhombic loads OpenImageIO, VTK, Pango or GDCM, or what comes with them, before a command needs them, or if it
# says nothing useful without its libraries.
# cmake -DPROGRAM=<rhombic> -DLIBRARY=<rhombic-on-demand.so>
#       -DFOLDER=<where it belongs, as lib/rhombic> -DSCAN=<a scan> -DWORK=<scratch folder> -P check-start.cmake

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}/bin")

# Sets the variable slow to the libraries that take long to load, of those that a command loads, by the record of the
# dynamic linker.
function(list_slow_libraries)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LD_DEBUG=files "${PROGRAM}" -q ${ARGN}
                  RESULT_VARIABLE status ERROR_VARIABLE record OUTPUT_QUIET)
  if(NOT status EQUAL 0 OR NOT record MATCHES "libITKCommon")
    message(FATAL_ERROR "rhombic ${ARGN}: exit code ${status}, and no record of its libraries: ${record}")
  endif()
  string(REGEX MATCHALL "lib(OpenImageIO|opencv|OpenEXR|tiff|heif|raw|avcodec|vtk[CR]|pango|gdcm)[^ /;]*" slow "${record}")
  list(REMOVE_DUPLICATES slow)
  set(slow "${slow}" PARENT_SCOPE)
endfunction()

set(mesh mesh "${SCAN}" -t 375.5 -o "${WORK}/bone.stl")
foreach(command "--version" "--help" "info;${SCAN}" "${mesh}")
  list_slow_libraries(${command})
  if(slow)
    message(FATAL_ERROR "rhombic ${command} loads ${slow}")
  endif()
endforeach()
list_slow_libraries(render --help)
if(slow MATCHES "OpenImageIO|opencv")
  message(FATAL_ERROR "rhombic render loads ${slow} before it draws")
endif()
list_slow_libraries(render "${WORK}/bone.stl" --size 32 -o "${WORK}/bone.png")
foreach(library OpenImageIO vtkCommonCore pango gdcm)
  if(NOT slow MATCHES "${library}")
    message(FATAL_ERROR "The libraries that render loads for a picture are not seen: ${library} is not in ${slow}")
  endif()
endforeach()

function(check_sentence_without library purpose)
  execute_process(COMMAND "${WORK}/bin/rhombic" doctor RESULT_VARIABLE status ERROR_VARIABLE sentence OUTPUT_QUIET)
  if(NOT status EQUAL 1 OR NOT sentence MATCHES "^rhombic: .*${purpose}.*${library}.*install rhombic again\\.\n$")
    message(FATAL_ERROR "Without ${library}: exit code ${status}, ${sentence}")
  endif()
endfunction()

file(COPY "${PROGRAM}" DESTINATION "${WORK}/bin")
check_sentence_without(rhombic-on-demand.so "runs rhombic doctor")
file(COPY "${LIBRARY}" DESTINATION "${WORK}/${FOLDER}")
check_sentence_without(rhombic-pictures.so "reads and writes pictures")
