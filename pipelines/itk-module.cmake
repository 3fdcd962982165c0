itk_module(Pipelines
  DEPENDS ScanIO FCCResampling FCCIsosurface SurfaceIO SurfaceRendering PictureIO
  PRIVATE_DEPENDS ITKIOGDCM ITKIONIFTI yaml-cpp
  DESCRIPTION "Compositions of the modules: scan to surfaces, scan to picture; presets; the analytic phantom.")
