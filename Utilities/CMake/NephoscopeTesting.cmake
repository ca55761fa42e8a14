# Tests beside what they test, labelled by layer: kernels, fits, io, filters, rendering, program, integration, python,
# examples, install, house.
find_package(GTest REQUIRED)
include(GoogleTest)
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# nephoscope_add_test(NAME LABEL label SOURCES s... DEPENDS targets... [WINDOW]): one GoogleTest program, one CTest entry.
# WINDOW: it opens windows, on a display of its own; without xvfb-run it is skipped.
find_program(Nephoscope_XVFB_RUN xvfb-run)
mark_as_advanced(Nephoscope_XVFB_RUN)
function (nephoscope_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "WINDOW" "LABEL;TIMEOUT" "SOURCES;DEPENDS")
  if (NOT test_TIMEOUT)
    set(test_TIMEOUT 300)
  endif ()
  add_executable(${name} ${test_SOURCES})
  target_link_libraries(${name} PRIVATE ${test_DEPENDS} GTest::gtest_main)
  target_compile_definitions(${name} PRIVATE
    NEPHOSCOPE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    NEPHOSCOPE_SHARED_DATA_DIR="${PROJECT_SOURCE_DIR}/../shared/data")
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/tests")
  if (NOT test_WINDOW)
    add_test(NAME ${name} COMMAND ${name})
  elseif (Nephoscope_XVFB_RUN)
    # -noreset: a server that resets when a test closes its last window refuses the window opened meanwhile.
    add_test(NAME ${name}
      COMMAND "${Nephoscope_XVFB_RUN}" -a -s "-screen 0 1280x1024x24 -noreset" $<TARGET_FILE:${name}>)
    # The software OpenGL driver leaks when it is unloaded; the modules' own leaks show in the other tests.
    set_tests_properties(${name} PROPERTIES ENVIRONMENT "ASAN_OPTIONS=detect_leaks=0")
  else ()
    add_test(NAME ${name} COMMAND "${CMAKE_COMMAND}" -E echo "Skipped: no xvfb-run, install xvfb")
    set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "Skipped: no xvfb-run")
  endif ()
  set_tests_properties(${name} PROPERTIES LABELS "${test_LABEL}" TIMEOUT ${test_TIMEOUT})
endfunction ()

# nephoscope_add_python_test(NAME LABEL label COMMAND script arguments...): a Python script beside the CMakeLists.txt.
function (nephoscope_add_python_test name)
  cmake_parse_arguments(PARSE_ARGV 1 test "" "LABEL;TIMEOUT" "COMMAND")
  if (NOT test_TIMEOUT)
    set(test_TIMEOUT 300)
  endif ()
  add_test(NAME ${name}
    COMMAND "${Python3_EXECUTABLE}" -B ${test_COMMAND}
    WORKING_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}")
  set_tests_properties(${name} PROPERTIES LABELS "${test_LABEL}" TIMEOUT ${test_TIMEOUT}
    ENVIRONMENT "PYTHONPATH=${CMAKE_BINARY_DIR}/${Nephoscope_PYTHON_DESTINATION}")
endfunction ()

file(GLOB test_folders CONFIGURE_DEPENDS
  "${PROJECT_SOURCE_DIR}/Modules/*/Testing/Cxx" "${PROJECT_SOURCE_DIR}/Testing/*" "${PROJECT_SOURCE_DIR}/Examples/*"
  "${PROJECT_SOURCE_DIR}/Utilities/*/Testing")
foreach (folder IN LISTS test_folders)
  if (EXISTS "${folder}/CMakeLists.txt")
    file(RELATIVE_PATH place "${PROJECT_SOURCE_DIR}" "${folder}")
    add_subdirectory("${folder}" "${CMAKE_BINARY_DIR}/${place}")
  endif ()
endforeach ()
