itk_module(SurfaceIO
  DEPENDS RhombicCommon Sandbox TriangleSurface
  PRIVATE_DEPENDS ZLIB::ZLIB EXPAT::EXPAT nlohmann_json::nlohmann_json
  DESCRIPTION "Surfaces as STL, PLY, OBJ, VTP, GLB and 3MF files: written completely or not at all, and read, also from other programs.")
