itk_module(ScanIO
  DEPENDS RhombicCommon Sandbox FCCLattice ITKCommon ITKIOImageBase
  PRIVATE_DEPENDS ITKGDCM ITKIONIFTI ITKIONRRD ITKIOMeta ITKExpat nlohmann_json::nlohmann_json
  DESCRIPTION "DICOM folders, NIfTI, NRRD and MetaImage volumes and label maps as ITK images in LPS millimetres, and files of lattice volumes.")
