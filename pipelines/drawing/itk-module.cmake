itk_module(DrawingPipelines
  DEPENDS Pipelines SurfaceRendering
  PRIVATE_DEPENDS PictureIO
  DESCRIPTION "From a scan to pictures. Apart from the other pipelines, so that programs that do not draw load no library for it.")
