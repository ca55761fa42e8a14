# Every switch of the build, its default, and the flags that follow from it.
include(GNUInstallDirs)
include(CTest)

option(BUILD_SHARED_LIBS "Build shared libraries" ON)
option(Nephoscope_WRAP_PYTHON "Build the Python package nephoscope" ON)
option(Nephoscope_WITH_PARAVIEW "Build the plugin for the ParaView in ParaView_DIR, and nothing else" OFF)
option(Nephoscope_WARNINGS_AS_ERRORS "Compile with -Werror" OFF)
# Debian's interpreter: another python3 on PATH has no vtkmodules.
set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "Python whose vtkmodules is VTK's own")
set(Nephoscope_SANITIZE "" CACHE STRING "Sanitizers for the whole build, e.g. address,undefined")

# Ceres, for Modules/Fits alone; without it the rest is built and reads the calibrations that there are. Found by its files, as
# CeresConfig.cmake brings TBB targets that clash with VTK's.
option(Nephoscope_FITS "Build the fits if Ceres is there" ON)
find_path(Nephoscope_CERES_INCLUDE ceres/ceres.h)
find_library(Nephoscope_CERES_LIBRARY ceres)
find_library(Nephoscope_GLOG_LIBRARY glog)
find_path(Nephoscope_EIGEN_INCLUDE Eigen/Dense PATH_SUFFIXES eigen3)
mark_as_advanced(Nephoscope_CERES_INCLUDE Nephoscope_CERES_LIBRARY Nephoscope_GLOG_LIBRARY Nephoscope_EIGEN_INCLUDE)
set(Nephoscope_REJECTED_MODULES "")
if (NOT (Nephoscope_FITS AND Nephoscope_CERES_INCLUDE AND Nephoscope_CERES_LIBRARY AND Nephoscope_GLOG_LIBRARY AND
    Nephoscope_EIGEN_INCLUDE))
  message(STATUS "Without fits: Ceres is not wanted or not found (Debian: libceres-dev)")
  list(APPEND Nephoscope_REJECTED_MODULES Nephoscope::CloudFits)
endif ()

# OpenVDB, for Modules/Sparse alone; found by its files too, as FindOpenVDB.cmake brings the same TBB targets.
option(Nephoscope_OPENVDB "Read and write OpenVDB files if OpenVDB is there" ON)
find_path(Nephoscope_OPENVDB_INCLUDE openvdb/openvdb.h)
find_library(Nephoscope_OPENVDB_LIBRARY openvdb)
find_library(Nephoscope_TBB_LIBRARY tbb)
find_library(Nephoscope_IMATH_LIBRARY NAMES Imath Imath-3_1)
mark_as_advanced(Nephoscope_OPENVDB_INCLUDE Nephoscope_OPENVDB_LIBRARY Nephoscope_TBB_LIBRARY
  Nephoscope_IMATH_LIBRARY)
if (NOT (Nephoscope_OPENVDB AND Nephoscope_OPENVDB_INCLUDE AND Nephoscope_OPENVDB_LIBRARY AND Nephoscope_TBB_LIBRARY AND
    Nephoscope_IMATH_LIBRARY))
  message(STATUS "Without OpenVDB: it is not wanted or not found (Debian: libopenvdb-dev)")
  list(APPEND Nephoscope_REJECTED_MODULES Nephoscope::CloudSparse)
endif ()

if (NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif ()

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_BINDIR}")
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_ARCHIVE_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
set(Nephoscope_CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/nephoscope")

add_compile_options(-Wall -Wextra)
if (Nephoscope_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif ()
if (Nephoscope_SANITIZE)
  add_compile_options(-fsanitize=${Nephoscope_SANITIZE} -fno-sanitize-recover=all
    -fno-omit-frame-pointer)
  # GCC 12 takes instrumented code of its own <regex> for uninitialized.
  add_compile_options(-Wno-maybe-uninitialized)
  add_link_options(-fsanitize=${Nephoscope_SANITIZE})
endif ()

# The VTK modules that ours depend on, directly or in tests.
set(Nephoscope_VTK_COMPONENTS
  CommonCore CommonDataModel CommonExecutionModel CommonMath CommonTransforms
  FiltersCore FiltersFlowPaths FiltersGeneral FiltersGeometry FiltersHybrid FiltersSources
  IOCore IOImage IOXML ParallelCore RenderingCore RenderingOpenGL2 RenderingVolume RenderingVolumeOpenGL2)
if (Nephoscope_WRAP_PYTHON)
  list(APPEND Nephoscope_VTK_COMPONENTS WrappingPythonCore WrappingTools)
endif ()
