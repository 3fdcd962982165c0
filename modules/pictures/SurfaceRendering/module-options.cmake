set_source_files_properties("${folder}/src/rhombicGLContext.cxx" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
