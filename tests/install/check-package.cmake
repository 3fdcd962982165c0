# Makes the Debian packages of the build, unpacks them, runs the program, and builds consumers against the libraries.
# cmake -DBUILD=<build tree> -DCPACK=<cpack> -DMULTIARCH=<Debian's name of the architecture>
#       <what consumers.cmake needs> -P check-package.cmake

include("${CMAKE_CURRENT_LIST_DIR}/consumers.cmake")

# Unpacks a package into a folder of its own, and looks at what any package must have.
function(unpack package)
  file(GLOB file "${WORK}/packages/${package}_*.deb")
  run(dpkg-deb --extract "${file}" "${WORK}/${package}")
  foreach(document README.md copyright changelog.gz)
    if(NOT EXISTS "${WORK}/${package}/usr/share/doc/${package}/${document}")
      message(FATAL_ERROR "${package} has no /usr/share/doc/${package}/${document}")
    endif()
  endforeach()
  run(dpkg-deb --field "${file}" Maintainer)
  if(NOT output MATCHES "^[A-Z][^<]+ <[^@ ]+@[^@ ]+>\n$")
    message(FATAL_ERROR "The maintainer of ${package} is no name with an address: ${output}")
  endif()
  run(dpkg-deb --field "${file}" Description)
  if(NOT output MATCHES "\n \\.\n ")
    message(FATAL_ERROR "${package} is described by a title alone: ${output}")
  endif()
  run(dpkg-deb --show "--showformat=\${Depends}, \${Recommends}" "${file}")
  message("${package} needs ${output}")
  set(needed "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE "${WORK}")
run(${CPACK} -G DEB --config "${BUILD}/CPackConfig.cmake" -B "${WORK}/packages")

unpack(rhombic)
foreach(library libinsighttoolkit5 libvtk9 libopenimageio)
  if(NOT needed MATCHES "${library}")
    message(FATAL_ERROR "rhombic does not say that it needs ${library}: ${needed}")
  endif()
endforeach()
set(manual "${WORK}/rhombic/usr/share/man/man1")
run("${WORK}/rhombic/usr/bin/rhombic" --help)
string(REGEX MATCH "Subcommands:.*\n\n" commands "${output}")
string(REGEX MATCHALL "\n  [a-z]+" commands "${commands}")
list(TRANSFORM commands REPLACE "\n  " "rhombic-")
foreach(page rhombic ${commands})
  run(gzip --decompress --stdout "${manual}/${page}.1.gz")
  if(NOT output MATCHES "\n\\.SH OPTIONS\n")
    message(FATAL_ERROR "The manual's page ${page} tells no options:\n${output}")
  endif()
endforeach()
run("${WORK}/rhombic/usr/bin/rhombic" -q mesh "${SCAN}" -t 375.5 -o "${WORK}/bone.stl")

unpack(librhombic-dev)
string(REGEX MATCHALL "[a-z][a-z0-9.+-]+" names "${needed}")
run(dpkg-query --show ${names}) # fails if one is not the name of a package that the build has
if(NOT EXISTS "${WORK}/librhombic-dev/usr/lib/${MULTIARCH}/cmake/Rhombic/RhombicConfig.cmake")
  message(FATAL_ERROR "librhombic-dev has no RhombicConfig.cmake where Debian's libraries are: configure with "
                      "-U CMAKE_INSTALL_LIBDIR if the build tree is an old one")
endif()
check_consumer(lattice "${WORK}/librhombic-dev/usr" -DCMAKE_DISABLE_FIND_PACKAGE_VTK=ON)
check_consumer(full "${WORK}/librhombic-dev/usr")
