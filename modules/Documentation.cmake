# The reference of all public headers: `cmake --build build/dev --target docs`, in build/dev/docs/html. Warnings of
# Doxygen's are errors, but for what the conventions leave undocumented (tests/docs/check-reference.cmake).

find_package(Doxygen)
if(NOT DOXYGEN_FOUND)
  return()
endif()
set(DOXYGEN_PROJECT_BRIEF "${PROJECT_DESCRIPTION}")
set(DOXYGEN_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/docs")
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE "${PROJECT_SOURCE_DIR}/README.md")
set(DOXYGEN_STRIP_FROM_PATH "${PROJECT_SOURCE_DIR}")
set(DOXYGEN_FILE_PATTERNS *.h *.md)
set(DOXYGEN_EXCLUDE_PATTERNS */include/detail/*)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_IF_INCOMPLETE_DOC NO) # parameters that their names explain are left out
set(DOXYGEN_WARN_LOGFILE "${DOXYGEN_OUTPUT_DIRECTORY}/warnings.txt")
set(DOXYGEN_HIDE_UNDOC_CLASSES NO)
set(DOXYGEN_EXTRACT_ALL NO)
set(DOXYGEN_SORT_BRIEF_DOCS YES)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
set(DOXYGEN_GENERATE_LATEX NO)
set(DOXYGEN_MACRO_EXPANSION YES)
set(DOXYGEN_EXPAND_ONLY_PREDEF YES)
set(DOXYGEN_SEARCH_INCLUDES NO)
set(DOXYGEN_PREDEFINED
    "ITK_TEMPLATE_EXPORT="
    "ITKv5_CONST=const"
    "ITK_DISALLOW_COPY_AND_MOVE(type)="
    "itkNewMacro(type)=static Pointer New()\;"
    "itkFactorylessNewMacro(type)=static Pointer New()\;"
    "itkTypeMacro(type,base)="
    "itkSetMacro(name,type)=virtual void Set##name(type name)\;"
    "itkGetConstMacro(name,type)=virtual type Get##name() const\;"
    "itkGetConstReferenceMacro(name,type)=virtual const type & Get##name() const\;"
    "itkSetClampMacro(name,type,lowest,highest)=virtual void Set##name(type name)\;"
    "itkSetEnumMacro(name,type)=virtual void Set##name(type name)\;"
    "itkGetEnumMacro(name,type)=virtual type Get##name() const\;"
    "itkBooleanMacro(name)=virtual void name##On()\; virtual void name##Off()\;"
    "itkSetStringMacro(name)=virtual void Set##name(const std::string & name)\;"
    "itkGetStringMacro(name)=virtual const char * Get##name() const\;"
    "itkSetInputMacro(name,type)=virtual void Set##name(const type * input)\;"
    "itkGetInputMacro(name,type)=virtual const type * Get##name() const\;"
    "vtkTypeMacro(type,base)="
    "vtkSetMacro(name,type)=virtual void Set##name(type name)\;"
    "vtkGetMacro(name,type)=virtual type Get##name()\;"
    "vtkSetClampMacro(name,type,lowest,highest)=virtual void Set##name(type name)\;"
    "vtkBooleanMacro(name,type)=virtual void name##On()\; virtual void name##Off()\;"
    "vtkSetEnumMacro(name,type)=virtual void Set##name(type name)\;"
    "vtkGetEnumMacro(name,type)=virtual type Get##name()\;"
    "vtkGetObjectMacro(name,type)=virtual type * Get##name()\;"
    "RHOMBIC_INSTANTIATE(declaration,image)=")
file(GLOB pages README.md apps/*/*.md modules/README.md modules/*/*/README.md pipelines/README.md pipelines/*/*.md tests/README.md
     tests/*/README.md testdata/README.md)
file(GLOB headers modules/*/*/include pipelines/include pipelines/*/include)
doxygen_add_docs(docs ${headers} ${pages} COMMENT "Writing build/.../docs/html")
add_custom_command(TARGET docs POST_BUILD
                   COMMAND ${CMAKE_COMMAND} "-DREFERENCE=${DOXYGEN_OUTPUT_DIRECTORY}"
                           -P "${PROJECT_SOURCE_DIR}/tests/docs/check-reference.cmake" VERBATIM)
