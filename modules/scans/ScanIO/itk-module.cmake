itk_module(ScanIO
  DEPENDS RhombicCommon FCCLattice ITKCommon
  PRIVATE_DEPENDS ITKIOImageBase ITKGDCM ITKIONIFTI ITKIONRRD ITKIOMeta ITKExpat ZLIB::ZLIB nlohmann_json::nlohmann_json
  DESCRIPTION "DICOM folders, NIfTI, NRRD and MetaImage volumes and label maps as ITK images in LPS millimetres, and files of lattice volumes.")
