# Debian's OpenImageIO target lists the include folder of an OpenCV that is not installed with it.
function(rhombic_openimageio_without_opencv)
  get_target_property(directories OpenImageIO::OpenImageIO INTERFACE_INCLUDE_DIRECTORIES)
  list(FILTER directories EXCLUDE REGEX opencv)
  set_target_properties(OpenImageIO::OpenImageIO PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${directories}")
endfunction()
