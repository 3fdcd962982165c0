# Rows of bits and the tetrahedra of a column, which isosurfaces use too.
target_include_directories(FCCLabelSurfaces PRIVATE $<TARGET_PROPERTY:FCCIsosurface,RHOMBIC_SOURCE_FOLDERS>)
