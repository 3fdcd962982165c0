itk_module(DrawingPipelines
  DEPENDS Pipelines AgreementPipelines SurfaceRendering SlicePictures
  PRIVATE_DEPENDS SurfaceVTK PageDrawing PictureIO InteractivePage
  DESCRIPTION "From a scan to pictures. Apart from the other pipelines, so that programs that do not draw load no library for it.")
