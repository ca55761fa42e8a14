# The Python package: one extension module per wrapped VTK module, the package's own files, and stubs for both.
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
file(GLOB package_files RELATIVE "${package_source}" CONFIGURE_DEPENDS "${package_source}/*.py" "${package_source}/py.typed")
foreach (file IN LISTS package_files)
  configure_file("${package_source}/${file}" "${package_build}/${file}" COPYONLY)
endforeach ()
install(DIRECTORY "${package_source}" DESTINATION "${Nephoscope_PYTHON_DESTINATION}"
  FILES_MATCHING PATTERN "*.py" PATTERN "py.typed")

# One package with stubs is enough: they are the same for ParaView's VTK.
if (Nephoscope_WITH_PARAVIEW)
  return ()
endif ()

# Type stubs, for editors and type checkers, of what the extension modules say of themselves.
set(stubs "${CMAKE_BINARY_DIR}/CMakeFiles/nephoscope-stubs")
set(extension_modules "${wrapped_modules}")
list(TRANSFORM extension_modules REPLACE "^Nephoscope::(.*)$" "vtk\\1Python")
set(stub_maker "${PROJECT_SOURCE_DIR}/Utilities/Python/Stubs/stubs.py")
add_custom_command(
  OUTPUT "${stubs}/__init__.pyi"
  COMMAND "${CMAKE_COMMAND}" -E env "PYTHONPATH=${CMAKE_BINARY_DIR}/${Nephoscope_PYTHON_DESTINATION}"
    "${Python3_EXECUTABLE}" -B "${stub_maker}" "${stubs}"
  COMMAND "${CMAKE_COMMAND}" -E copy_directory "${stubs}" "${package_build}"
  DEPENDS ${extension_modules} "${stub_maker}" "${package_source}/__init__.py"
  COMMENT "Writing type stubs of the Python package")
add_custom_target(nephoscope_stubs ALL DEPENDS "${stubs}/__init__.pyi")
install(DIRECTORY "${stubs}/" DESTINATION "${Nephoscope_PYTHON_DESTINATION}/nephoscope" FILES_MATCHING PATTERN "*.pyi")
