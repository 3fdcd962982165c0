itk_module(PageDrawing
  DEPENDS RhombicCommon
  PRIVATE_DEPENDS PkgConfig::pangocairo
  DESCRIPTION "Letters, scale bars and legends over pictures, and pages of pictures, as pictures or PDF.")
