target_include_directories(BatchPipelines PRIVATE "${PROJECT_SOURCE_DIR}/pipelines/src" # keys of YAML files
                                                  $<TARGET_PROPERTY:ScanIO,RHOMBIC_SOURCE_FOLDERS>) # names of volume files
