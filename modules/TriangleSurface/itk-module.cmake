itk_module(TriangleSurface
  DEPENDS ITKCommon ITKMesh ITKQuadEdgeMesh
  PRIVATE_DEPENDS RhombicCommon
  DESCRIPTION "A compact triangle mesh as an ITK data object: topology, components, measures, quality, and converters from and to ITK's meshes. No VTK.")
