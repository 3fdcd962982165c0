itk_module(SurfaceVTK
  DEPENDS RhombicCommon TriangleSurface VTK::CommonCore VTK::CommonDataModel
  PRIVATE_DEPENDS VTK::IOXML nlohmann_json::nlohmann_json
  DESCRIPTION "The triangle surface as vtkPolyData, without a copy, and files that VTK reads.")
