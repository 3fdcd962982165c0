itk_module(FCCResampling
  DEPENDS RhombicCommon FCCLattice FCCInterpolation ITKCommon
  DESCRIPTION "Filters from Cartesian images to FCC images and back.")
