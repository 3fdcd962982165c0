# What the checks of an installation share. They need SOURCE, this folder; SCAN, a scan; WORK, a scratch folder;
# GENERATOR and LAUNCHER, the build's generator and compiler launcher.

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Builds and runs the program of the folder `name` with what is installed under `prefix`.
function(check_consumer name prefix)
  set(build "${WORK}/${name}")
  run(${CMAKE_COMMAND} -S "${SOURCE}/${name}" -B "${build}" -G ${GENERATOR} "-DCMAKE_PREFIX_PATH=${prefix}"
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} ${ARGN})
  run(${CMAKE_COMMAND} --build "${build}")
  file(MAKE_DIRECTORY "${build}/output")
  run("${build}/consumer" "${SCAN}" "${build}/output")
  message("${name}: ${output}")
endfunction()
