# The plugin for an installed ParaView, the Python package for ParaView's Python, and their tests, in place of the modules for VTK: -DNephoscope_WITH_PARAVIEW=ON -DParaView_DIR=...
enable_language(C) # ParaView finds MPI for C
# Named components: all of them would want Qt's development files.
find_package(ParaView 5.11 REQUIRED COMPONENTS RemotingCore RemotingServerManager RemotingViews WrapClientServer ProcessXML)
find_package(VTK REQUIRED COMPONENTS ${Nephoscope_VTK_COMPONENTS} PATHS "${ParaView_DIR}/vtk" NO_DEFAULT_PATH)

paraview_plugin_scan(
  PLUGIN_FILES "${PROJECT_SOURCE_DIR}/Utilities/ParaView/paraview.plugin"
  PROVIDES_PLUGINS plugins
  ENABLE_BY_DEFAULT ON)
paraview_plugin_build(
  PLUGINS ${plugins}
  PLUGINS_FILE_NAME "nephoscope.xml"
  AUTOLOAD ${plugins}
  ADD_INSTALL_RPATHS ON
  DISABLE_XML_DOCUMENTATION ON)

# The package nephoscope once more, for ParaView's Python.
set(modules Nephoscope::CloudIO Nephoscope::CloudSources Nephoscope::CloudFilters Nephoscope::CloudRendering
  Nephoscope::CloudSparse)
list(REMOVE_ITEM modules ${Nephoscope_REJECTED_MODULES} "")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../../../Nephoscope") # from the installed package to the plugin's libraries
include(NephoscopePython)

if (BUILD_TESTING)
  find_program(Nephoscope_XVFB_RUN xvfb-run REQUIRED)
  add_subdirectory(Testing/ParaView)
endif ()
