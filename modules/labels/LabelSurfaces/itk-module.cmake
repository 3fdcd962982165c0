itk_module(LabelSurfaces
  DEPENDS RhombicCommon TriangleSurface SurfaceEditing ScanIO FCCLabelSurfaces ITKCommon
  PRIVATE_DEPENDS FCCResampling SurfaceQueries
  DESCRIPTION "Closed surfaces of the labels of a label map, without the steps of its voxels.")
