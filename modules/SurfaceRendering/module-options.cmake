# A static library's symbols are hidden from the shared libraries of a program; this one must be found before GLEW's.
target_link_options(SurfaceRendering INTERFACE LINKER:--export-dynamic-symbol=glxewInit)
