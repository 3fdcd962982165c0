itk_module(TriangleSurface
  DEPENDS ITKCommon
  PRIVATE_DEPENDS RhombicCommon
  DESCRIPTION "A compact triangle mesh as an ITK data object, with its audit, measures and spatial index. No VTK.")
