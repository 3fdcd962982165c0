# The table of anatomical colours becomes part of the library, so that programs need no files beside them.
set(colour_table "${CMAKE_CURRENT_LIST_DIR}/data/anatomical-colours.tsv")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${colour_table}")
file(STRINGS "${colour_table}" lines REGEX "^[^#]")
list(POP_FRONT lines) # the names of the columns
set(rules "")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^([a-z0-9.]+)\t([a-z0-9.]*)\t([0-9]+)\t([0-9]+)\t([0-9]+)\t([a-z ]+)$")
    message(FATAL_ERROR "${colour_table}: this line is no word, second word, red, green, blue, group: ${line}")
  endif()
  string(APPEND rules "  { \"${CMAKE_MATCH_1}\", \"${CMAKE_MATCH_2}\", "
                      "{ ${CMAKE_MATCH_3}, ${CMAKE_MATCH_4}, ${CMAKE_MATCH_5} }, \"${CMAKE_MATCH_6}\" },\n")
endforeach()
file(CONFIGURE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/ScanIO/rhombicAnatomicalColourRules.inc" CONTENT "${rules}" @ONLY)
target_include_directories(ScanIO PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/ScanIO")

rhombic_add_helper(rhombic-unpack-dicom FOR ScanIO LINKS FCCLattice ITKGDCM nlohmann_json::nlohmann_json
                   SOURCES "${folder}/helper/rhombicUnpackDicom.cxx" "${folder}/src/dicom/rhombicCompressedFrame.cxx")
target_include_directories(rhombic-unpack-dicom PRIVATE "${folder}/src/dicom")

rhombic_add_helper(rhombic-unpack-gzip FOR ScanIO SOURCES "${folder}/helper/rhombicUnpackGzip.cxx" LINKS ZLIB::ZLIB)

rhombic_add_helper(rhombic-unpack-picture FOR ScanIO SOURCES "${folder}/helper/rhombicUnpackPicture.cxx"
                   LINKS OpenImageIO::OpenImageIO ITKExpat nlohmann_json::nlohmann_json)

# An object of its own, which the linker leaves out of programs that write no DICOM, and with it GDCM, whose dictionaries
# take 0.04 s to load.
set_source_files_properties("${folder}/src/dicom/rhombicDicomCapture.cxx" PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
