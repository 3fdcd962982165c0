# A static library's symbols are hidden from the shared libraries of a program; this one must be found before GLEW's.
target_link_options(SurfaceRendering INTERFACE LINKER:--export-dynamic-symbol=glxewInit)
# X11's headers define None, Status and more as macros: what includes them is compiled alone.
set_source_files_properties("${folder}/src/rhombicEGLContext.cxx" "${folder}/src/rhombicGLXContext.cxx"
                            PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
