itk_module(FCCLattice
  DEPENDS ITKCommon
  PRIVATE_DEPENDS RhombicCommon
  DESCRIPTION "Images sampled on the face-centered cubic lattice, and their files. The only place that knows the lattice's geometry.")
