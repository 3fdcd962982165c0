itk_module(SurfaceIO
  DEPENDS RhombicCommon TriangleSurface
  PRIVATE_DEPENDS SurfaceVTK VTK::IOGeometry VTK::IOXML
  DESCRIPTION "Surfaces as STL, PLY and VTP files that are written completely or not at all.")
