itk_module(Pipelines
  DEPENDS ScanIO ScanPreparation LabelMaps FCCResampling FCCIsosurface PatientIsolation LabelSurfaces SurfaceQueries SurfaceEditing
          SurfaceMeasurement SurfaceIO nlohmann_json::nlohmann_json
  PRIVATE_DEPENDS yaml-cpp
  DESCRIPTION "Compositions of the modules from a scan to lattices and surfaces, and the presets.")
