itk_module(FCCIsosurface
  DEPENDS RhombicCommon FCCLattice TriangleSurface
  DESCRIPTION "Isosurfaces of FCC images by marching the lattice's tetrahedra.")
