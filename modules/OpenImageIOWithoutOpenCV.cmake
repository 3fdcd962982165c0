# Debian's OpenImageIO target lists the include folder of an OpenCV that is not installed with it.
function(rhombic_openimageio_without_opencv)
  if(TARGET OpenImageIO::OpenImageIO)
    get_property(directories TARGET OpenImageIO::OpenImageIO PROPERTY INTERFACE_INCLUDE_DIRECTORIES)
    list(FILTER directories EXCLUDE REGEX opencv)
    set_property(TARGET OpenImageIO::OpenImageIO PROPERTY INTERFACE_INCLUDE_DIRECTORIES "${directories}")
  endif()
endfunction()
