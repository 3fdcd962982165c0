# The viewer becomes part of the library: its page, its style, and its sources one after the other as one script. The
# hashes let the page's Content-Security-Policy allow this style and this script, and no other.
set(web "${folder}/web")
set(RHOMBIC_PAGE_SCRIPT "")
foreach(part vendor/meshopt_decoder_reference data geometry scene slices list clip measure layers main)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${web}/${part}.js")
  file(READ "${web}/${part}.js" text)
  string(APPEND RHOMBIC_PAGE_SCRIPT "${text}")
endforeach()
foreach(part page.html page.css)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${web}/${part}")
endforeach()
file(READ "${web}/page.html" RHOMBIC_PAGE_TEMPLATE)
file(READ "${web}/page.css" RHOMBIC_PAGE_STYLE)
string(SHA256 RHOMBIC_PAGE_STYLE_HASH "${RHOMBIC_PAGE_STYLE}")
string(SHA256 RHOMBIC_PAGE_SCRIPT_HASH "${RHOMBIC_PAGE_SCRIPT}")
configure_file("${folder}/src/rhombicPageResources.h.in" "${CMAKE_CURRENT_BINARY_DIR}/InteractivePage/rhombicPageResources.h"
               @ONLY)
target_include_directories(${module_name} PRIVATE "${CMAKE_CURRENT_BINARY_DIR}/InteractivePage")
