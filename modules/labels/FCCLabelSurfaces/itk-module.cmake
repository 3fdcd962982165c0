itk_module(FCCLabelSurfaces
  DEPENDS FCCLattice TriangleSurface SurfaceEditing ITKCommon
  PRIVATE_DEPENDS RhombicCommon SurfaceQueries
  DESCRIPTION "One mesh of the walls between the labels of an FCC image.")
