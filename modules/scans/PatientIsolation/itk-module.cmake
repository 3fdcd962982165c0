itk_module(PatientIsolation
  DEPENDS RhombicCommon FCCLattice TriangleSurface ScanIO
  PRIVATE_DEPENDS SurfaceQueries ITKConnectedComponents ITKDistanceMap
  DESCRIPTION "Separates the patient from the surroundings: removes the table from a CT, and keeps the parts of a surface that lie in the body.")
