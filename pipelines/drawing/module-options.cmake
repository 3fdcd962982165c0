target_include_directories(DrawingPipelines PRIVATE "${PROJECT_SOURCE_DIR}/pipelines/src") # loading and reports
