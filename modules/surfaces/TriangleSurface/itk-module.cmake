itk_module(TriangleSurface
  DEPENDS RhombicCommon ITKCommon ITKMesh ITKQuadEdgeMesh
  DESCRIPTION "A compact triangle mesh as an ITK data object: topology, components, measures, quality, and converters from and to ITK's meshes. No VTK.")
