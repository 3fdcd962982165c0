itk_module(OMEZarr
  DEPENDS RhombicCommon ITKCommon ITKIOImageBase
  PRIVATE_DEPENDS Sandbox nlohmann_json::nlohmann_json
  DESCRIPTION "Images in OME-Zarr 0.4 folders, read by region and pyramid level, in LPS millimetres, and an ImageIO for ITK's readers.")
