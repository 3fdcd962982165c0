itk_module(Phantom
  DEPENDS RhombicCommon ITKCommon
  PRIVATE_DEPENDS ITKGDCM ITKIONIFTI
  DESCRIPTION "An analytic body of exactly known organ volumes, as a CT scan with its labels.")
