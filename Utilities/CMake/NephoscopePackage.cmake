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

# The calibrations, which CalibrationPath.h finds in either tree.
set(calibrations "${CMAKE_INSTALL_DATADIR}/nephoscope/Calibration")
file(MAKE_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_DATADIR}/nephoscope")
file(CREATE_LINK "${PROJECT_SOURCE_DIR}/Data/Calibration" "${CMAKE_BINARY_DIR}/${calibrations}" SYMBOLIC)
install(DIRECTORY "${PROJECT_SOURCE_DIR}/Data/Calibration" DESTINATION "${CMAKE_INSTALL_DATADIR}/nephoscope")
