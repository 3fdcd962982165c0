itk_module(ScanIO
  DEPENDS RhombicCommon Sandbox OMEZarr FCCLattice ITKCommon ITKIOImageBase
  PRIVATE_DEPENDS ITKGDCM ITKIONIFTI ITKIONRRD ITKIOMeta ITKExpat nlohmann_json::nlohmann_json
  DESCRIPTION "DICOM folders, NIfTI, NRRD, MetaImage and OME-Zarr volumes and label maps as ITK images in LPS millimetres, and files of lattice volumes.")
