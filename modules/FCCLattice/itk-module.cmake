itk_module(FCCLattice
  DEPENDS ITKCommon
  DESCRIPTION "Images sampled on the face-centered cubic lattice. The only place that knows the lattice's geometry.")
