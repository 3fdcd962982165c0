itk_module(Pipelines
  DEPENDS ScanIO LabelSurfaces FCCResampling FCCIsosurface SurfaceIO SurfaceRendering PictureIO nlohmann_json::nlohmann_json
  PRIVATE_DEPENDS ITKAnisotropicSmoothing ITKConnectedComponents ITKDistanceMap ITKStatistics ITKThresholding yaml-cpp
  DESCRIPTION "Compositions of the modules from a scan to surfaces and pictures, and the presets.")
