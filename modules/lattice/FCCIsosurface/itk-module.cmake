itk_module(FCCIsosurface
  DEPENDS RhombicCommon FCCLattice TriangleSurface
  PRIVATE_DEPENDS hwy::hwy
  DESCRIPTION "Isosurfaces of FCC images by marching the lattice's cells.")
