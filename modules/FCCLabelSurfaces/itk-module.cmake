itk_module(FCCLabelSurfaces
  DEPENDS FCCLattice TriangleSurface ITKCommon
  PRIVATE_DEPENDS RhombicCommon FCCIsosurface
  DESCRIPTION "One mesh of the walls between the labels of an FCC image.")
