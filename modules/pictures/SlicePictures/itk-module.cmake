itk_module(SlicePictures
  DEPENDS RhombicCommon TriangleSurface ScanIO
  PRIVATE_DEPENDS FCCResampling
  DESCRIPTION "Slices through scans: planes, grey values in a window, outlines of surfaces, and cuts filled with grey values.")
