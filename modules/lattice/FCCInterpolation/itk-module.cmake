itk_module(FCCInterpolation
  DEPENDS RhombicCommon FCCLattice ITKImageFunction
  DESCRIPTION "Values between the samples of an FCC image.")
