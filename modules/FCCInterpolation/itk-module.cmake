itk_module(FCCInterpolation
  DEPENDS FCCLattice ITKImageFunction
  DESCRIPTION "Values between the samples of an FCC image.")
