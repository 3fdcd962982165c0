itk_module(FCCLattice
  DEPENDS RhombicCommon ITKCommon
  DESCRIPTION "Images sampled on the face-centered cubic lattice, and the lattice's geometry.")
