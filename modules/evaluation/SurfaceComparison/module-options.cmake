# The kernel is compiled once for each instruction set: the oldest that the compiler targets, AVX2 and AVX-512.
target_compile_definitions(SurfaceComparison PRIVATE "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3_DL)")
target_include_directories(SurfaceComparison PRIVATE "${folder}/src") # it includes itself
