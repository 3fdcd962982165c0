# Helpers link the child's side, in objects of their own, without ITK.
set_source_files_properties("${folder}/src/rhombicSandboxChild.cxx" "${folder}/src/rhombicSandboxMessage.cxx"
                            PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_compile_definitions(Sandbox PRIVATE
  RHOMBIC_SANDBOX_VERSION="${PROJECT_VERSION}" RHOMBIC_HELPER_FOLDER="../${CMAKE_INSTALL_LIBEXECDIR}/rhombic")
