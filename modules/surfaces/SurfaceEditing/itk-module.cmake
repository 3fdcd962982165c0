itk_module(SurfaceEditing
  DEPENDS RhombicCommon TriangleSurface SurfaceQueries
  PRIVATE_DEPENDS hwy::hwy meshoptimizer::meshoptimizer
  DESCRIPTION "Changes of a triangle surface: simplification, smoothing, untangling, removal of parts, and an order of triangles that renders fast.")
