itk_module(ScanPreparation
  DEPENDS RhombicCommon ScanIO
  PRIVATE_DEPENDS FCCResampling ITKAnisotropicSmoothing ITKImageGrid ITKStatistics ITKThresholding
  DESCRIPTION "From a scan as it is read to one that is resampled: axes in the patient's order, less noise, thresholds of its values.")
