itk_module(SurfaceMeasurement
  DEPENDS RhombicCommon FCCLattice FCCResampling TriangleSurface SurfaceQueries ScanIO
  DESCRIPTION "What a surface encloses, and how far it is from the isosurface of the scan that it was made from.")
