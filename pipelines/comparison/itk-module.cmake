itk_module(ComparisonPipelines INTERNAL
  DEPENDS RhombicCommon SurfaceComparison nlohmann_json::nlohmann_json
  PRIVATE_DEPENDS Pipelines ScanIO ScanPreparation ITKSmoothing ITKImageGrid SurfaceRendering PageDrawing PictureIO VTK::CommonCore yaml-cpp
  DESCRIPTION "Experiments that compare lattices and methods, from a file to tables, plots and pictures.")
