rhombic_add_helper(rhombic-unpack-chunk FOR OMEZarr SOURCES "${folder}/helper/rhombicUnpackChunk.cxx" LINKS ZLIB::ZLIB PkgConfig::blosc PkgConfig::zstd)
