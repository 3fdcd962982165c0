set_source_files_properties("${folder}/src/vtkRhombicHeadlessRenderWindow.cxx" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
