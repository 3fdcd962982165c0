itk_module(SurfaceVTK
  DEPENDS TriangleSurface VTK::CommonCore VTK::CommonDataModel
  DESCRIPTION "The triangle surface as vtkPolyData, without a copy.")
