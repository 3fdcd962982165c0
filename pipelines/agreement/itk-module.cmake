itk_module(AgreementPipelines
  DEPENDS Pipelines SurfaceAgreement
  PRIVATE_DEPENDS ITKConnectedComponents ITKDistanceMap ITKTransform ITKTransformFactory
                  VTK::CommonDataModel meshoptimizer::meshoptimizer
  DESCRIPTION "Agreement of two segmentations, label by label, as a table.")
