itk_module(SurfaceRendering
  DEPENDS RhombicCommon TriangleSurface
  PRIVATE_DEPENDS VTK::RenderingCore VTK::RenderingOpenGL2 OpenGL::EGL OpenGL::GL
  DESCRIPTION "Surfaces drawn offscreen, without an X server, in anatomical views.")
