# Fails if rhombic loads OpenImageIO, or what comes with it, before it writes a picture, or if it says nothing useful
# without the library rhombic-pictures.so.
# cmake -DPROGRAM=<rhombic> -DSCAN=<a scan> -DWORK=<scratch folder> -P check-start.cmake

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}/bin")

# Sets the variable slow to the libraries of OpenImageIO that a command loads, by the record of the dynamic linker.
function(list_slow_libraries)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LD_DEBUG=files "${PROGRAM}" -q ${ARGN}
                  RESULT_VARIABLE status ERROR_VARIABLE record OUTPUT_QUIET)
  if(NOT status EQUAL 0 OR NOT record MATCHES "libITKCommon")
    message(FATAL_ERROR "rhombic ${ARGN}: exit code ${status}, and no record of its libraries: ${record}")
  endif()
  string(REGEX MATCHALL "lib(OpenImageIO|opencv|OpenEXR|tiff|heif|raw|avcodec)[^ /;]*" slow "${record}")
  list(REMOVE_DUPLICATES slow)
  set(slow "${slow}" PARENT_SCOPE)
endfunction()

set(mesh mesh "${SCAN}" -t 375.5 -o "${WORK}/bone.stl")
foreach(command "--version" "info;${SCAN}" "${mesh}")
  list_slow_libraries(${command})
  if(slow)
    message(FATAL_ERROR "rhombic ${command} loads ${slow}")
  endif()
endforeach()
list_slow_libraries(render "${WORK}/bone.stl" --size 32 -o "${WORK}/bone.png")
if(NOT slow MATCHES "OpenImageIO")
  message(FATAL_ERROR "The libraries that render loads for a picture are not seen: ${slow}")
endif()

file(COPY "${PROGRAM}" DESTINATION "${WORK}/bin")
execute_process(COMMAND "${WORK}/bin/rhombic" doctor RESULT_VARIABLE status ERROR_VARIABLE sentence OUTPUT_QUIET)
if(NOT status EQUAL 1 OR NOT sentence MATCHES "^rhombic: .*reads and writes pictures.*rhombic-pictures.so.*install rhombic again\\.\n$")
  message(FATAL_ERROR "Without rhombic-pictures.so: exit code ${status}, ${sentence}")
endif()
