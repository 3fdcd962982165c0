itk_module(TriangleSurface
  DEPENDS ITKCommon
  PRIVATE_DEPENDS RhombicCommon
  DESCRIPTION "A compact triangle mesh as an ITK data object, with its topology audit, area and volume. No VTK.")
