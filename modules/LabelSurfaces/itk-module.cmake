itk_module(LabelSurfaces
  DEPENDS RhombicCommon TriangleSurface ScanIO FCCIsosurface ITKCommon
  PRIVATE_DEPENDS FCCResampling SurfaceQueries ITKConnectedComponents
  DESCRIPTION "Closed surfaces of the labels of a label map, without the steps of its voxels.")
