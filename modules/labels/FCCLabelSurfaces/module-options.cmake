# Rows of bits and the tetrahedra of a column, which isosurfaces use too, and bounded moves of points.
target_include_directories(FCCLabelSurfaces PRIVATE $<TARGET_PROPERTY:FCCIsosurface,RHOMBIC_SOURCE_FOLDERS>
                                                    $<TARGET_PROPERTY:SurfaceEditing,RHOMBIC_SOURCE_FOLDERS>)
