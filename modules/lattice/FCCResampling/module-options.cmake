# Highway compiles src/itkRowArithmetic.cxx once for each SIMD target, by including it in itself.
target_include_directories(${module_name} PRIVATE "${folder}/src")
