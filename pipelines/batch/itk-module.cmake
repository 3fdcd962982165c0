itk_module(BatchPipelines
  DEPENDS Pipelines
  PRIVATE_DEPENDS ScanIO yaml-cpp
  DESCRIPTION "Many scans: each case in child processes, with a journal, a table of results and an index page.")
