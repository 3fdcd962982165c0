itk_module(ScanIO
  DEPENDS RhombicCommon Sandbox FCCLattice ITKCommon
  PRIVATE_DEPENDS ITKIOImageBase ITKGDCM ITKIONIFTI ITKIONRRD ITKIOMeta ITKExpat nlohmann_json::nlohmann_json
  DESCRIPTION "DICOM folders, NIfTI, NRRD and MetaImage volumes and label maps as ITK images in LPS millimetres, and files of lattice volumes.")
