itk_module(Pipelines
  DEPENDS ScanIO FCCResampling FCCIsosurface SurfaceIO SurfaceRendering PictureIO
  PRIVATE_DEPENDS ITKStatistics ITKThresholding yaml-cpp
  DESCRIPTION "Compositions of the modules from a scan to surfaces and pictures, and the presets.")
