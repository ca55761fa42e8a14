# The Python package: one extension module per wrapped VTK module, and the package's own files.
if (NOT Nephoscope_WRAP_PYTHON)
  return ()
endif ()
find_package(Python3 REQUIRED COMPONENTS Interpreter Development)
vtk_module_python_default_destination(Nephoscope_PYTHON_DESTINATION)
vtk_module_wrap_python(
  MODULES ${modules}
  TARGET Nephoscope::Python
  WRAPPED_MODULES wrapped_modules
  PYTHON_PACKAGE nephoscope
  MODULE_DESTINATION "${Nephoscope_PYTHON_DESTINATION}"
  INSTALL_HEADERS OFF
  LIBRARY_DESTINATION "${CMAKE_INSTALL_LIBDIR}")

set(package_source "${PROJECT_SOURCE_DIR}/Utilities/Python/nephoscope")
set(package_build "${CMAKE_BINARY_DIR}/${Nephoscope_PYTHON_DESTINATION}/nephoscope")
file(GLOB package_files RELATIVE "${package_source}" CONFIGURE_DEPENDS "${package_source}/*.py")
foreach (file IN LISTS package_files)
  configure_file("${package_source}/${file}" "${package_build}/${file}" COPYONLY)
endforeach ()
install(DIRECTORY "${package_source}" DESTINATION "${Nephoscope_PYTHON_DESTINATION}"
  FILES_MATCHING PATTERN "*.py")
