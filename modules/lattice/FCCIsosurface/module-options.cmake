# Kernels are compiled once for each instruction set: the oldest that the compiler targets, and AVX2.
target_compile_definitions(FCCIsosurface PRIVATE "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL)")
target_include_directories(FCCIsosurface PRIVATE "${CMAKE_CURRENT_LIST_DIR}/src") # they include themselves
# Roots that do not set errno and comparisons that do not trap become SIMD code; no result changes.
target_compile_options(FCCIsosurface PRIVATE -fno-math-errno -fno-trapping-math)
