itk_module(TriangleSurface
  DEPENDS ITKCommon ITKMesh ITKQuadEdgeMesh
  PRIVATE_DEPENDS RhombicCommon meshoptimizer::meshoptimizer
  DESCRIPTION "A compact triangle mesh as an ITK data object, with its audit, measures, smoothing, simplification, and converters from and to ITK's meshes. No VTK.")
