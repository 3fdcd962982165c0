# Highway compiles kernels once for each SIMD target, by including them in themselves.
target_include_directories(${module_name} PRIVATE "${folder}/src")
