itk_module(SurfaceVTK
  DEPENDS RhombicCommon TriangleSurface VTK::CommonCore VTK::CommonDataModel
  DESCRIPTION "The triangle surface as vtkPolyData, without a copy, and a program that reads files by VTK.")
