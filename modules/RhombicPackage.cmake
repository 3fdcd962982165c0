# What is installed beside the modules: the package's configuration, the program, its presets; and Debian packages of it
# all: `rhombic` with the program, `librhombic-dev` with the libraries and headers.

include(CMakePackageConfigHelpers)
get_property(RHOMBIC_MODULES GLOBAL PROPERTY RHOMBIC_MODULES)
set(RHOMBIC_DEPENDS "")
foreach(module IN LISTS RHOMBIC_MODULES)
  get_property(depends GLOBAL PROPERTY RHOMBIC_${module}_DEPENDS)
  string(APPEND RHOMBIC_DEPENDS "  set(${module}_DEPENDS ${depends})\n")
endforeach()
# The libraries are compiled against these minor versions; other ones have another C++ ABI.
set(RHOMBIC_VERSIONS "")
foreach(pair ITK/libinsighttoolkit5-dev VTK/libvtk9-dev OpenImageIO/libopenimageio-dev)
  string(REGEX MATCH "(.+)/(.+)" pair "${pair}")
  set(package ${CMAKE_MATCH_1})
  set(debian_package ${CMAKE_MATCH_2})
  string(REGEX MATCH "([0-9]+)\\.([0-9]+)" version "${${package}_VERSION}")
  math(EXPR next "${CMAKE_MATCH_2} + 1")
  string(APPEND RHOMBIC_VERSIONS "  set(_rhombic_${package}_version ${version})\n")
  set(${package}_DEBIAN_PACKAGE
      "${debian_package} (>= ${version}~), ${debian_package} (<< ${CMAKE_MATCH_1}.${next}~)")
endforeach()
set(HELPER_FOLDER "${CMAKE_INSTALL_LIBEXECDIR}/rhombic")
configure_package_config_file(modules/RhombicConfig.cmake.in "${PROJECT_BINARY_DIR}/RhombicConfig.cmake"
                              INSTALL_DESTINATION "${RHOMBIC_PACKAGE_FOLDER}" PATH_VARS HELPER_FOLDER
                              NO_CHECK_REQUIRED_COMPONENTS_MACRO NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/RhombicConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/RhombicConfig.cmake" "${PROJECT_BINARY_DIR}/RhombicConfigVersion.cmake"
              modules/OpenImageIOWithoutOpenCV.cmake
        DESTINATION "${RHOMBIC_PACKAGE_FOLDER}" COMPONENT development)

install(TARGETS rhombic RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
install(TARGETS rhombic-on-demand rhombic-pictures LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}/rhombic" COMPONENT program)
install(DIRECTORY pipelines/presets DESTINATION "${CMAKE_INSTALL_DATADIR}/rhombic" COMPONENT program)
install(PROGRAMS pipelines/batch/job-array.sh pipelines/batch/shard-array.sh pipelines/batch/receive-study.sh
        DESTINATION "${CMAKE_INSTALL_DATADIR}/rhombic/batch" COMPONENT program)
install(FILES pipelines/batch/Snakefile DESTINATION "${CMAKE_INSTALL_DATADIR}/rhombic/batch" COMPONENT program)
install(DIRECTORY pipelines/batch/slurm-7 pipelines/batch/slurm-8 DESTINATION "${CMAKE_INSTALL_DATADIR}/rhombic/batch"
        COMPONENT program)
set(program_package rhombic)
set(development_package librhombic-dev)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS modules/changelog)
execute_process(COMMAND gzip -9nc "${PROJECT_SOURCE_DIR}/modules/changelog"
                OUTPUT_FILE "${PROJECT_BINARY_DIR}/changelog.gz" COMMAND_ERROR_IS_FATAL ANY)
foreach(component program development)
  install(FILES README.md LICENSE modules/copyright "${PROJECT_BINARY_DIR}/changelog.gz" COMPONENT ${component}
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${${component}_package}")
  install(FILES apps/rhombic/GUIDE.md COMPONENT ${component}
          DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${${component}_package}/apps/rhombic")
endforeach()
install(FILES pipelines/batch/README.md COMPONENT program
        DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${program_package}/pipelines/batch")
install(FILES modules/README.md DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${development_package}/modules"
        COMPONENT development)
install(DIRECTORY apps/examples DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${development_package}" COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "Rhombic developers <rhombic@example.org>")
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "organ surfaces and pictures from medical scans")
set(method "Rhombic reads DICOM, NIfTI, NRRD, MetaImage and OME-Zarr volumes, resamples
them onto the face-centered cubic lattice, extracts closed isosurfaces by
marching its cells, and renders them without a window or an X server.\n")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME ${program_package})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-dejavu-core, libgl1-mesa-dri")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${method}\nThis package has the command line program.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME ${development_package})
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS # the program's package has the helpers that readers start
    "rhombic (= ${PROJECT_VERSION})" "${ITK_DEBIAN_PACKAGE}" libexpat1-dev libhwy-dev libmeshoptimizer-dev nlohmann-json3-dev zlib1g-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS # for the components of rendering, pictures and pipelines alone
    "${VTK_DEBIAN_PACKAGE}" "${OpenImageIO_DEBIAN_PACKAGE}" libegl-dev libgif-dev libjpeg-dev libpango1.0-dev libyaml-cpp-dev openimageio-tools)
list(JOIN CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)
list(JOIN CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${method}\nThis package has its modules for programs of your own:
static libraries, headers, and the CMake package Rhombic.")
include(CPack)
