# rhombic_add_module(<folder>)
#
# Makes one library target from a folder shaped like an ITK module, as modules/lattice/FCCLattice:
#   itk-module.cmake  its declaration, in ITK's own grammar (itk_module(<name> DEPENDS ... DESCRIPTION ...))
#   include/          public headers        src/  sources, if any, maybe in folders by theme
#   include/detail/   headers that public templates need, but that no user includes: "detail/itkX.h"
#   module-options.cmake  what the target needs beyond its dependencies, if anything
#
# Dependencies may be ITK modules (ITKCommon), modules of this project, or imported targets (VTK::CommonCore).
# A module of this project must have been added before it is depended on, so the order of modules/CMakeLists.txt is
# the order of dependency. With RHOMBIC_BUILD_TESTING every public header is also compiled alone. Each module is a
# component of the installed package (RhombicConfig.cmake.in); its target is Rhombic::<name>, there and here.
#
# The word INTERNAL in the declaration keeps a module out of the installed package: itk_module(<name> INTERNAL DEPENDS
# ... DESCRIPTION ...). Programs, tests and other internal modules may depend on it, installed modules may not.

macro(itk_module name)
  set(module_name ${name})
  cmake_parse_arguments(module "INTERNAL" "DESCRIPTION" "DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  if(NOT module_DESCRIPTION OR module_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "itk_module(${name}): DESCRIPTION is missing, or unknown words: ${module_UNPARSED_ARGUMENTS}")
  endif()
endmacro()

function(_rhombic_link target scope)
  foreach(dependency IN LISTS ARGN)
    if(dependency MATCHES "^ITK")
      itk_module_config(_itk ${dependency})
      target_link_libraries(${target} ${scope} ${_itk_LIBRARIES})
      target_include_directories(${target} SYSTEM ${scope} "$<BUILD_INTERFACE:${_itk_INCLUDE_DIRS}>")
    elseif(TARGET ${dependency})
      target_link_libraries(${target} ${scope} ${dependency})
    else()
      message(FATAL_ERROR "${target} depends on ${dependency}, which is no ITK module, no imported target and no module added before it")
    endif()
  endforeach()
endfunction()

# Headers beside the sources are found by their names alone. The folders are a property of the module too, for the tests
# of its parts: RHOMBIC_SOURCE_FOLDERS.
function(_rhombic_add_source_folders name folder)
  file(GLOB headers CONFIGURE_DEPENDS "${folder}/src/*.h" "${folder}/src/*/*.h")
  set(folders)
  foreach(header IN LISTS headers)
    get_filename_component(header_folder "${header}" DIRECTORY)
    list(APPEND folders "${header_folder}")
  endforeach()
  list(REMOVE_DUPLICATES folders)
  target_include_directories(${name} PRIVATE ${folders})
  set_target_properties(${name} PROPERTIES RHOMBIC_SOURCE_FOLDERS "${folders}")
endfunction()

# A unity build (CMakePresets.json) compiles several sources as one, which parses their headers once. Sources that
# Highway compiles once for each instruction set include themselves, so they stay alone.
function(_rhombic_keep_kernels_out_of_unity sources)
  foreach(source IN LISTS sources)
    file(STRINGS "${source}" kernel REGEX "HWY_TARGET_INCLUDE")
    if(kernel)
      set_source_files_properties("${source}" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

function(_rhombic_add_header_test name headers)
  set(sources)
  foreach(header IN LISTS headers)
    get_filename_component(file ${header} NAME)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/${name}HeaderTest/${file}.cxx")
    file(CONFIGURE OUTPUT "${source}" CONTENT "#include \"${file}\" // IWYU pragma: keep\n")
    list(APPEND sources "${source}")
  endforeach()
  add_library(${name}HeaderTest OBJECT ${sources})
  set_target_properties(${name}HeaderTest PROPERTIES UNITY_BUILD OFF) # each header alone
  target_link_libraries(${name}HeaderTest PRIVATE ${name} RhombicOptions)
  target_compile_options(${name}HeaderTest PRIVATE -O0)
endfunction()

# rhombic_add_helper(<name> [INTERNAL] FOR <module> SOURCES <sources...> LINKS <as DEPENDS in itk-module.cmake...>)
#
# A program that SandboxRun starts for a module, installed unless it is internal. It links only what its sources need: it
# must start fast.
function(rhombic_add_helper name)
  cmake_parse_arguments(helper "INTERNAL" "FOR" "SOURCES;LINKS" ${ARGN})
  add_executable(${name} ${helper_SOURCES})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF
    RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBEXECDIR}/rhombic")
  target_link_options(${name} PRIVATE LINKER:--as-needed)
  target_link_libraries(${name} PRIVATE Sandbox RhombicOptions)
  _rhombic_link(${name} PRIVATE ${helper_LINKS})
  add_dependencies(${helper_FOR} ${name})
  if(NOT helper_INTERNAL)
    install(TARGETS ${name} RUNTIME DESTINATION "${CMAKE_INSTALL_LIBEXECDIR}/rhombic" COMPONENT program)
  endif()
endfunction()

function(_rhombic_install name folder)
  file(GLOB headers CONFIGURE_DEPENDS "${folder}/include/*.h" "${folder}/include/*.hxx")
  file(GLOB detail_headers CONFIGURE_DEPENDS "${folder}/include/detail/*.h")
  set_target_properties(${name} PROPERTIES OUTPUT_NAME Rhombic${name})
  install(TARGETS ${name} EXPORT Rhombic${name} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development)
  install(FILES ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/Rhombic" COMPONENT development)
  install(FILES ${detail_headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/Rhombic/detail" COMPONENT development)
  install(EXPORT Rhombic${name} NAMESPACE Rhombic:: FILE Rhombic${name}.cmake DESTINATION "${RHOMBIC_PACKAGE_FOLDER}"
          COMPONENT development)
endfunction()

function(rhombic_add_module folder)
  include("${folder}/itk-module.cmake")
  file(GLOB headers CONFIGURE_DEPENDS "${folder}/include/*.h")
  file(GLOB sources CONFIGURE_DEPENDS "${folder}/src/*.cxx" "${folder}/src/*/*.cxx")
  if(sources)
    add_library(${module_name} ${sources})
    target_link_libraries(${module_name} PRIVATE $<BUILD_INTERFACE:RhombicOptions>)
    _rhombic_add_source_folders(${module_name} "${folder}")
    _rhombic_keep_kernels_out_of_unity("${sources}")
    set(scope PUBLIC)
    set(private_scope PRIVATE)
  else()
    add_library(${module_name} INTERFACE)
    set(scope INTERFACE)
    set(private_scope INTERFACE)
  endif()
  add_library(Rhombic::${module_name} ALIAS ${module_name})
  target_compile_features(${module_name} ${scope} cxx_std_17)
  target_include_directories(${module_name} ${scope} "$<BUILD_INTERFACE:${folder}/include>"
                                                     "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/Rhombic>")
  _rhombic_link(${module_name} ${scope} ${module_DEPENDS})
  _rhombic_link(${module_name} ${private_scope} ${module_PRIVATE_DEPENDS})
  include("${folder}/module-options.cmake" OPTIONAL)
  if(NOT module_INTERNAL)
    _rhombic_install(${module_name} "${folder}")
    set_property(GLOBAL APPEND PROPERTY RHOMBIC_MODULES ${module_name})
    set_property(GLOBAL PROPERTY RHOMBIC_${module_name}_DEPENDS ${module_DEPENDS} ${module_PRIVATE_DEPENDS})
  endif()
  if(RHOMBIC_BUILD_TESTING AND headers)
    _rhombic_add_header_test(${module_name} "${headers}")
  endif()
endfunction()
