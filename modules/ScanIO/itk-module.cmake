itk_module(ScanIO
  DEPENDS RhombicCommon ITKCommon
  PRIVATE_DEPENDS ITKIOImageBase ITKGDCM ITKIONIFTI ITKIONRRD ITKIOMeta ZLIB::ZLIB
  DESCRIPTION "DICOM folders, NIfTI, NRRD and MetaImage volumes as ITK images in LPS millimetres.")
