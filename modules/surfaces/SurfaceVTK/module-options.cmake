rhombic_add_helper(rhombic-unpack-vtp FOR SurfaceIO SOURCES "${folder}/helper/rhombicUnpackVTP.cxx"
                   LINKS VTK::IOXML nlohmann_json::nlohmann_json)
