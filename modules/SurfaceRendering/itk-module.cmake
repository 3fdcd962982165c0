itk_module(SurfaceRendering
  DEPENDS RhombicCommon TriangleSurface
  PRIVATE_DEPENDS SurfaceVTK VTK::RenderingCore VTK::RenderingOpenGL2 VTK::RenderingFreeType OpenGL::EGL OpenGL::GL X11::X11
  DESCRIPTION "Surfaces drawn offscreen, without an X server, in anatomical views.")
