itk_module(AgreementPipelines
  DEPENDS Pipelines SurfaceAgreement
  PRIVATE_DEPENDS ITKTransform ITKIOTransformBase ITKIOTransformInsightLegacy
  DESCRIPTION "Agreement of two segmentations, label by label, as a table.")
