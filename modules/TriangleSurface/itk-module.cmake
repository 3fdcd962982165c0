itk_module(TriangleSurface
  DEPENDS ITKCommon
  PRIVATE_DEPENDS RhombicCommon meshoptimizer::meshoptimizer
  DESCRIPTION "A compact triangle mesh as an ITK data object, with its topology audit, area and volume, simplification and smoothing. No VTK.")
