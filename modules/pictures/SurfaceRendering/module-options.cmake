set_source_files_properties("${folder}/src/rhombicCallersContext.cxx" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
