itk_module(RhombicCommon
  DEPENDS ITKCommon
  DESCRIPTION "What every other module needs: the one exception type, output files that appear whole or not at all, the picture buffer.")
