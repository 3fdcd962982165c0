itk_module(TriangleSurface
  DEPENDS ITKCommon
  PRIVATE_DEPENDS RhombicCommon meshoptimizer::meshoptimizer
  DESCRIPTION "A compact triangle mesh as an ITK data object, with its audit, measures, spatial index, simplification and smoothing. No VTK.")
