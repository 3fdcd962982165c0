# Highway compiles src/itkRowArithmetic.cxx once for each SIMD target, by including it in itself.
target_include_directories(${module_name} PRIVATE "${folder}/src")
# Loops with comparisons become SIMD code only if the compiler may forget floating-point exceptions; values stay the same.
target_compile_options(${module_name} PRIVATE -fno-trapping-math)
