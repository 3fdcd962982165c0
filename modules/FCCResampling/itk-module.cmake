itk_module(FCCResampling
  DEPENDS FCCLattice FCCInterpolation ITKCommon
  DESCRIPTION "Filters from Cartesian images to FCC images and back.")
