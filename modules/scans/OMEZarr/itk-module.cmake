itk_module(OMEZarr
  DEPENDS RhombicCommon Sandbox ITKCommon ITKIOImageBase
  PRIVATE_DEPENDS nlohmann_json::nlohmann_json
  DESCRIPTION "Images in OME-Zarr 0.4 folders, read by region and pyramid level, in LPS millimetres, and an ImageIO for ITK's readers.")
