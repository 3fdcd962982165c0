itk_module(ScanIO
  DEPENDS RhombicCommon ITKCommon ITKIOImageBase
  PRIVATE_DEPENDS ITKIOGDCM ITKIONIFTI ITKIONRRD ITKIOMeta
  DESCRIPTION "DICOM folders, NIfTI, NRRD and MetaImage volumes as ITK images in LPS millimetres.")
