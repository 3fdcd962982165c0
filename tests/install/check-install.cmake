# Installs the build, moves what was installed elsewhere, and builds and runs consumers against it.
# cmake -DBUILD=<build tree> <what consumers.cmake needs> -P check-install.cmake

include("${CMAKE_CURRENT_LIST_DIR}/consumers.cmake")

file(REMOVE_RECURSE "${WORK}")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${WORK}/first place")
file(RENAME "${WORK}/first place" "${WORK}/prefix")

check_consumer(lattice "${WORK}/prefix" -DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON -DCMAKE_DISABLE_FIND_PACKAGE_OpenImageIO=ON)
run(ldd "${WORK}/lattice/consumer")
if(output MATCHES "vtk|OpenImageIO|yaml")
  message(FATAL_ERROR "The lattice alone is linked with more than it needs:\n${output}")
endif()
check_consumer(full "${WORK}/prefix")
foreach(file bone.stl bone.png)
  file(SIZE "${WORK}/full/output/${file}" size)
  if(size LESS 1000)
    message(FATAL_ERROR "${file} has ${size} bytes")
  endif()
endforeach()

# What can't be had is refused by name, unless it is optional.
function(check_refusal component sentence)
  execute_process(COMMAND ${CMAKE_COMMAND} -S "${SOURCE}/lattice" -B "${WORK}/refused" -G ${GENERATOR} --fresh
                          "-DCMAKE_PREFIX_PATH=${WORK}/prefix" -DCMAKE_DISABLE_FIND_PACKAGE_OpenImageIO=ON
                          "-DCOMPONENT=${component}"
                  RESULT_VARIABLE status ERROR_VARIABLE output OUTPUT_QUIET)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(status EQUAL 0 OR NOT output MATCHES "${sentence}")
    message(FATAL_ERROR "${component} is not refused with '${sentence}':\n${output}")
  endif()
endfunction()
check_refusal(Nonsense "there is no component Nonsense")
check_refusal(PictureIO "PictureIO needs OpenImageIO\\.")
run(${CMAKE_COMMAND} -S "${SOURCE}/lattice" -B "${WORK}/optional" -G ${GENERATOR} "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    -DCMAKE_DISABLE_FIND_PACKAGE_OpenImageIO=ON "-DCOMPONENT=OPTIONAL_COMPONENTS;PictureIO;Nonsense")

run("${WORK}/prefix/bin/rhombic" --version)
run("${WORK}/prefix/bin/rhombic" -q mesh "${SCAN}" -t 375.5 -o "${WORK}/bone.stl")
file(SHA256 "${WORK}/bone.stl" mesh)
message("rhombic: ${mesh}")
