itk_module(SurfaceComparison INTERNAL
  DEPENDS RhombicCommon FCCLattice TriangleSurface SurfaceQueries FCCIsosurface ITKCommon ITKImageFunction VTK::CommonDataModel
  PRIVATE_DEPENDS VTK::FiltersCore hwy::hwy
  DESCRIPTION "Fields whose surfaces are known exactly, VTK's extractors as baselines, and the errors of a surface.")
