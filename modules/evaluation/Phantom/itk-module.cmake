itk_module(Phantom INTERNAL
  DEPENDS RhombicCommon ITKCommon
  PRIVATE_DEPENDS ScanIO ITKGDCM
  DESCRIPTION "An analytic body of exactly known organ volumes, as a CT scan with its labels.")
