# GCC 12's vectorizer of statements changes the arithmetic of simplification: bytes at -O3 then differ from those at -O1
# and -O3 without it, which are the same (tests/endurance.sh compiler-O1 compiler-no-slp).
target_compile_options(${module_name} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>)
# Highway compiles src/itkTriangleDistances.cxx once for each SIMD target, by including it in itself.
target_include_directories(${module_name} PRIVATE "${folder}/src")
