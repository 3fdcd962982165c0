# Installs the build, moves what was installed elsewhere, and builds and runs consumers against it.
# cmake -DBUILD=<build tree> <what consumers.cmake needs> -P check-install.cmake

include("${CMAKE_CURRENT_LIST_DIR}/consumers.cmake")

file(REMOVE_RECURSE "${WORK}")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${WORK}/first place")
file(RENAME "${WORK}/first place" "${WORK}/prefix")

# A consumer's variables, whatever their names, are no business of the package's: here it has all that the package uses.
file(GLOB_RECURSE scripts "${WORK}/prefix/*/RhombicConfig.cmake" "${WORK}/prefix/*/OpenImageIOWithoutOpenCV.cmake")
set(variables "")
foreach(script IN LISTS scripts)
  file(READ "${script}" text)
  string(REGEX MATCHALL "[a-z][a-z_]+" words "${text}")
  list(APPEND variables ${words})
endforeach()
list(REMOVE_DUPLICATES variables)
list(TRANSFORM variables REPLACE "(.+)" "set(\\1 \"the consumer's own\")\n")
list(JOIN variables "" variables)
file(WRITE "${WORK}/variables.cmake" "${variables}")
set(with_variables "-DCMAKE_PROJECT_INCLUDE=${WORK}/variables.cmake")

check_consumer(lattice "${WORK}/prefix" -DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON -DCMAKE_DISABLE_FIND_PACKAGE_OpenImageIO=ON
               "${with_variables}")
run(ldd "${WORK}/lattice/consumer")
if(output MATCHES "vtk|OpenImageIO|yaml")
  message(FATAL_ERROR "The lattice alone is linked with more than it needs:\n${output}")
endif()
check_consumer(zarr "${WORK}/prefix" "${with_variables}")
check_consumer(full "${WORK}/prefix" "${with_variables}")
foreach(file bone.stl bone.png)
  file(SIZE "${WORK}/full/output/${file}" size)
  if(size LESS 1000)
    message(FATAL_ERROR "${file} has ${size} bytes")
  endif()
endforeach()

# The examples by themselves, as they are installed.
run(${CMAKE_COMMAND} -S "${WORK}/prefix/share/doc/librhombic-dev/examples" -B "${WORK}/examples" -G ${GENERATOR}
    "-DCMAKE_PREFIX_PATH=${WORK}/prefix" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build "${WORK}/examples")
run("${WORK}/examples/ResampleAndSave" "${SCAN}" "${WORK}/example.fcc.nrrd")
message("ResampleAndSave: ${output}")
run("${WORK}/examples/ShrinkScan" "${SCAN}" 4 "${WORK}/small.mha")
run("${WORK}/prefix/bin/rhombic" info "${WORK}/small.mha")

run("${WORK}/examples/DrawInVTK" "${WORK}/balls.png")
file(SIZE "${WORK}/balls.png" size)
message("DrawInVTK: ${size} bytes")

# The program of the map, as it stands there.
file(READ "${WORK}/prefix/share/doc/librhombic-dev/modules/README.md" map)
foreach(pair cmake/CMakeLists.txt cpp/bone.cxx)
  string(REPLACE "/" ";" pair "${pair}")
  list(POP_FRONT pair language file)
  string(REGEX MATCH "```${language}\n([^`]+)```" block "${map}")
  file(WRITE "${WORK}/map/${file}" "${CMAKE_MATCH_1}")
endforeach()
run(${CMAKE_COMMAND} -S "${WORK}/map" -B "${WORK}/map/build" -G ${GENERATOR} "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build "${WORK}/map/build")
foreach(scan "${SCAN}" "${SCAN}/../phantom.nii.gz")
  run("${WORK}/map/build/bone" "${scan}" "${WORK}/map/bone.stl")
  run("${WORK}/prefix/bin/rhombic" audit "${WORK}/map/bone.stl")
  message("The program of modules/README.md: ${output}")
endforeach()

# A program with filters and a writer of ITK's own, built as the map tells.
string(REGEX MATCHALL "```cmake\n[^`]+```" blocks "${map}")
list(GET blocks 1 block)
string(REGEX REPLACE "```(cmake\n)?" "" block "${block}")
file(WRITE "${WORK}/median/CMakeLists.txt" "${block}")
file(COPY "${SOURCE}/median/median.cxx" DESTINATION "${WORK}/median")
run(${CMAKE_COMMAND} -S "${WORK}/median" -B "${WORK}/median/build" -G ${GENERATOR} "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build "${WORK}/median/build")
run("${WORK}/median/build/median" "${SCAN}" "${WORK}/median.nrrd" "${WORK}/median.stl")
run("${WORK}/prefix/bin/rhombic" info "${WORK}/median.nrrd")
run("${WORK}/prefix/bin/rhombic" audit "${WORK}/median.stl")
message("The program with filters of ITK: ${output}")
check_cluster_files("${WORK}/prefix")

# What can't be had is refused by name, unless it is optional; so are packages of other versions than those in the build.
function(check_refusal component sentence)
  execute_process(COMMAND ${CMAKE_COMMAND} -S "${SOURCE}/lattice" -B "${WORK}/refused" -G ${GENERATOR} --fresh
                          "-DCMAKE_PREFIX_PATH=${WORK}/prefix" "-DCOMPONENT=${component}" ${ARGN}
                  RESULT_VARIABLE status ERROR_VARIABLE output OUTPUT_QUIET)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(status EQUAL 0 OR NOT output MATCHES "${sentence}")
    message(FATAL_ERROR "${component} is not refused with '${sentence}':\n${output}")
  endif()
endfunction()
check_refusal(Nonsense "there is no component Nonsense")
foreach(internal SurfaceComparison Phantom)
  check_refusal(${internal} "there is no component ${internal}")
endforeach()
set(without_openimageio -DCMAKE_DISABLE_FIND_PACKAGE_OpenImageIO=ON)
check_refusal(PictureIO "PictureIO needs the OpenImageIO [0-9]+\\.[0-9]+ it was built with\\." ${without_openimageio})
run(${CMAKE_COMMAND} -S "${SOURCE}/lattice" -B "${WORK}/optional" -G ${GENERATOR} "-DCMAKE_PREFIX_PATH=${WORK}/prefix"
    ${without_openimageio} "-DCOMPONENT=OPTIONAL_COMPONENTS;PictureIO;Nonsense")
foreach(pair FCCLattice/ITK SurfaceVTK/VTK PictureIO/OpenImageIO)
  string(REPLACE "/" ";" pair "${pair}")
  list(POP_FRONT pair component package)
  set(other "${WORK}/other/${package}")
  file(WRITE "${other}/${package}Config.cmake" "")
  file(WRITE "${other}/${package}ConfigVersion.cmake" "set(PACKAGE_VERSION 99.1)\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
  check_refusal(${component} " ${component} needs the ${package} [0-9]+\\.[0-9]+ it was built with\\."
                "-D${package}_DIR=${other}")
endforeach()

run("${WORK}/prefix/bin/rhombic" --version)
run("${WORK}/prefix/bin/rhombic" -q mesh "${SCAN}" -t 375.5 -o "${WORK}/bone.stl")
run("${WORK}/prefix/bin/rhombic" -q render "${WORK}/bone.stl" --size 100 -o "${WORK}/bone.png") # finds rhombic-pictures.so
file(SHA256 "${WORK}/bone.stl" mesh)
message("rhombic: ${mesh}")
