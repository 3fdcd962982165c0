itk_module(SurfaceIO
  DEPENDS RhombicCommon Sandbox TriangleSurface
  PRIVATE_DEPENDS ZLIB::ZLIB nlohmann_json::nlohmann_json
  DESCRIPTION "Surfaces as STL, PLY, OBJ, VTP and GLB files: written completely or not at all, and read, also from other programs.")
