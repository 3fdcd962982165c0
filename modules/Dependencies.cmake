# Everything Rhombic uses from the outside; each is a Debian 12 package (pipelines/install-packages.sh).

find_package(ITK 5.2 REQUIRED)
find_package(MPI REQUIRED COMPONENTS C CXX) # Debian's VTK links it without looking for it
find_package(VTK 9.1 REQUIRED COMPONENTS CommonColor CommonCore CommonDataModel FiltersCore IOGeometry IOPLY IOXML
                                         RenderingCore RenderingFreeType RenderingOpenGL2)
find_package(OpenGL REQUIRED COMPONENTS EGL)
find_package(OpenImageIO 2.4 REQUIRED)
find_package(GIF 5 REQUIRED)
find_package(JPEG REQUIRED)
find_package(CLI11 REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(spdlog REQUIRED)
find_package(ZLIB REQUIRED)
find_package(EXPAT REQUIRED)
find_package(HWY REQUIRED)
find_package(meshoptimizer REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(blosc REQUIRED IMPORTED_TARGET blosc)           # PkgConfig::blosc
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)          # PkgConfig::zstd
pkg_check_modules(pangocairo REQUIRED IMPORTED_TARGET pangocairo) # PkgConfig::pangocairo

include("${CMAKE_CURRENT_LIST_DIR}/OpenImageIOWithoutOpenCV.cmake")
rhombic_openimageio_without_opencv()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()

# Compiler options of every target of this project.
add_library(RhombicOptions INTERFACE)
target_compile_options(RhombicOptions INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  -ffp-contract=off # the same bytes from every build
  $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage> # a unity build takes sources for headers
  $<$<BOOL:${RHOMBIC_STRICT}>:-Werror>)
if(RHOMBIC_SANITIZER)
  target_compile_options(RhombicOptions INTERFACE
    -fsanitize=${RHOMBIC_SANITIZER} -fno-sanitize-recover=all -fno-omit-frame-pointer
    $<$<CXX_COMPILER_ID:GNU>:-fsanitize-recover=pointer-overflow>) # for tests/ubsan.supp; halt_on_error ends the process
  target_link_options(RhombicOptions INTERFACE -fsanitize=${RHOMBIC_SANITIZER})
endif()
