itk_module(PictureIO
  DEPENDS RhombicCommon
  PRIVATE_DEPENDS OpenImageIO::OpenImageIO GIF::GIF JPEG::JPEG
  DESCRIPTION "Pictures as PNG, JPEG, TIFF, EXR and GIF files, PDF files, and comparison of pictures.")
