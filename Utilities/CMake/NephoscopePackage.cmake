# find_package(Nephoscope) from the build tree and from the install tree; vtk_module_build exports the targets.
include(CMakePackageConfigHelpers)
set(config_in "${CMAKE_CURRENT_LIST_DIR}/nephoscope-config.cmake.in")
foreach (place "${CMAKE_BINARY_DIR}/${Nephoscope_CMAKE_DESTINATION}" "${CMAKE_BINARY_DIR}/CMakeFiles/install")
  configure_package_config_file("${config_in}" "${place}/nephoscope-config.cmake"
    INSTALL_DESTINATION "${Nephoscope_CMAKE_DESTINATION}")
  write_basic_package_version_file("${place}/nephoscope-config-version.cmake"
    VERSION "${PROJECT_VERSION}" COMPATIBILITY SameMinorVersion)
endforeach ()
install(FILES
  "${CMAKE_BINARY_DIR}/CMakeFiles/install/nephoscope-config.cmake"
  "${CMAKE_BINARY_DIR}/CMakeFiles/install/nephoscope-config-version.cmake"
  DESTINATION "${Nephoscope_CMAKE_DESTINATION}")
