itk_module(PatientIsolation
  DEPENDS RhombicCommon FCCLattice TriangleSurface ScanIO
  PRIVATE_DEPENDS SurfaceQueries ITKConnectedComponents ITKDistanceMap
  DESCRIPTION "Tells the patient from what is around: removes the table from a CT, and keeps the parts of a surface that lie in the body.")
