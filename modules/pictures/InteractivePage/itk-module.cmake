itk_module(InteractivePage
  DEPENDS RhombicCommon TriangleSurface ScanIO SlicePictures
  PRIVATE_DEPENDS SurfaceQueries SurfaceEditing PictureIO meshoptimizer::meshoptimizer nlohmann_json::nlohmann_json ZLIB::ZLIB
  DESCRIPTION "An HTML file in which surfaces and slices of a scan can be turned, hidden, scrolled and measured, without a network.")
