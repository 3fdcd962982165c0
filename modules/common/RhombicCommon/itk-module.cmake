itk_module(RhombicCommon
  DEPENDS ITKCommon
  PRIVATE_DEPENDS ITKKWSys
  DESCRIPTION "What every other module needs: the one exception type, output files that appear whole or not at all, a limit of memory, work on several threads, the picture buffer.")
