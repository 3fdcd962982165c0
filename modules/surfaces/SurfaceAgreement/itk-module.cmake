itk_module(SurfaceAgreement
  DEPENDS TriangleSurface SurfaceQueries ITKCommon
  DESCRIPTION "How well two surfaces agree: Hausdorff distance and percentiles, mean distances, normalised surface Dice.")
