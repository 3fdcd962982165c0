itk_module(FCCResampling
  DEPENDS RhombicCommon FCCLattice FCCInterpolation ITKCommon
  PRIVATE_DEPENDS hwy::hwy
  DESCRIPTION "Filters from Cartesian images to FCC images and back.")
