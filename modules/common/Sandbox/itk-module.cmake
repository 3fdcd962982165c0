itk_module(Sandbox
  DEPENDS RhombicCommon
  DESCRIPTION "Child processes with limits: helper programs that unpack the bytes of files, one file at a time in each, and programs of a batch.")
