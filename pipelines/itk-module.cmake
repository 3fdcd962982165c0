itk_module(Pipelines
  DEPENDS ScanIO FCCResampling FCCIsosurface PatientIsolation LabelSurfaces SurfaceQueries SurfaceEditing SurfaceMeasurement SurfaceIO
          SurfaceRendering PictureIO nlohmann_json::nlohmann_json
  PRIVATE_DEPENDS ITKAnisotropicSmoothing ITKStatistics ITKThresholding yaml-cpp
  DESCRIPTION "Compositions of the modules from a scan to surfaces and pictures, and the presets.")
