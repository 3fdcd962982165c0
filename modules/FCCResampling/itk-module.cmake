itk_module(FCCResampling
  DEPENDS FCCLattice FCCInterpolation
  DESCRIPTION "Filters from Cartesian images to FCC images and back.")
