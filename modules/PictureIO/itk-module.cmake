itk_module(PictureIO
  DEPENDS RhombicCommon
  PRIVATE_DEPENDS OpenImageIO::OpenImageIO
  DESCRIPTION "Pictures as PNG, JPEG, TIFF and EXR files, and their comparison.")
