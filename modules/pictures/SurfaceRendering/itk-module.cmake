itk_module(SurfaceRendering
  DEPENDS RhombicCommon TriangleSurface VTK::RenderingCore VTK::RenderingOpenGL2
  PRIVATE_DEPENDS SurfaceVTK VTK::FiltersCore OpenGL::EGL OpenGL::GL
  DESCRIPTION "Surfaces drawn offscreen, without an X server, in anatomical views: render passes and a headless window of VTK.")
