itk_module(FCCIsosurface
  DEPENDS FCCLattice TriangleSurface
  DESCRIPTION "Isosurfaces of FCC images by marching the lattice's tetrahedra.")
