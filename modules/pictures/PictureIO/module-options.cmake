# An object of its own, which the linker leaves out of programs that define GetPictureCodec().
set_source_files_properties("${folder}/src/rhombicOpenImageIO.cxx" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
