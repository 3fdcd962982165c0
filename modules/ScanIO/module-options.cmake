# Reads the XML of label tables in NIfTI files.
_rhombic_link(${module_name} PRIVATE ITKExpat)
