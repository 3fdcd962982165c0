# Objects of their own, which the linker leaves out of programs that define GetPictureCodec().
set_source_files_properties("${folder}/src/rhombicOpenImageIO.cxx" "${folder}/src/rhombicGif.cxx" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
