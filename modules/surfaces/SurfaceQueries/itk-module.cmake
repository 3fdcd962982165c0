itk_module(SurfaceQueries
  DEPENDS TriangleSurface
  PRIVATE_DEPENDS RhombicCommon hwy::hwy
  DESCRIPTION "Questions to a triangle surface: nearest points, distances, inside or outside, solids and shells, self-intersections, and an audit of all flaws.")
