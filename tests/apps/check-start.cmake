# Fails if rhombic loads libraries that draw or write pictures at its start, or if it says nothing useful without
# rhombic-draw beside it.
# cmake -DPROGRAM=<rhombic> -DWORK=<scratch folder> -P check-start.cmake

file(REMOVE_RECURSE "${WORK}")
file(GET_RUNTIME_DEPENDENCIES EXECUTABLES "${PROGRAM}" RESOLVED_DEPENDENCIES_VAR libraries
     UNRESOLVED_DEPENDENCIES_VAR unresolved)
if(NOT libraries MATCHES "libITKCommon")
  message(FATAL_ERROR "The libraries of ${PROGRAM} can't be listed: ${libraries}")
endif()
string(REGEX MATCHALL "lib(vtk|OpenImageIO|GL|EGL|X11|pango|cairo)[^/;]*" drawing "${libraries}")
if(drawing)
  message(FATAL_ERROR "${PROGRAM} loads ${drawing}")
endif()

file(COPY "${PROGRAM}" DESTINATION "${WORK}/bin")
execute_process(COMMAND "${WORK}/bin/rhombic" doctor RESULT_VARIABLE status ERROR_VARIABLE sentence)
if(NOT status EQUAL 1 OR NOT sentence MATCHES "^rhombic: .*rhombic-draw.*can't be started.*install rhombic again, and mount /proc\\.\n$")
  message(FATAL_ERROR "Without rhombic-draw: exit code ${status}, ${sentence}")
endif()
