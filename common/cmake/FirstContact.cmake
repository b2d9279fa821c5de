# Compiler settings, dependencies, and the three functions that every CMakeLists.txt of the project calls.

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "" FORCE)
endif()
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
set(CMAKE_CXX_FLAGS_RELEASE "-O3")  # asserts stay on: a certified bound is worth a branch
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O2 -g1")

option(FC_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)

# Warnings are errors; a multiplication and an addition are never fused, so that error bounds hold as derived.
add_library(fc_settings INTERFACE)
target_compile_options(fc_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Werror -ffp-contract=off)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
  target_compile_options(fc_settings INTERFACE -Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)  # GCC bugs 105329, 105651: false alarms in std::string
endif()
if(FC_BENCH AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(fc_settings INTERFACE -Wno-maybe-uninitialized)  # GCC bug 105593: false alarms in AVX-512 headers
endif()
if(FC_BENCH)  # with -march=native Eigen would align its types more than the peers' libraries do, which share them
  target_compile_definitions(fc_settings INTERFACE EIGEN_MAX_STATIC_ALIGN_BYTES=16)
endif()
if(FC_SANITIZE)
  target_compile_options(fc_settings INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=all
                                               -fno-omit-frame-pointer
                                               -Wno-maybe-uninitialized)  # GCC's manual: sanitizers give false alarms
  target_link_options(fc_settings INTERFACE -fsanitize=address,undefined)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")  # compiling takes longer than running here: passes that gain little beside the checks
    target_compile_options(fc_settings INTERFACE -fno-tree-pta -fno-schedule-insns2 -fno-gcse -fno-tree-pre)
  endif()
endif()

find_package(Eigen3 REQUIRED NO_MODULE)
find_package(yaml-cpp REQUIRED)
if(NOT TARGET yaml-cpp::yaml-cpp)  # the name before yaml-cpp 0.8
  add_library(yaml-cpp::yaml-cpp ALIAS yaml-cpp)
endif()
find_package(fmt REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Qhull REQUIRED)
find_package(Threads REQUIRED)
# Where cpp-httplib is a compiled library, its header must be read with the settings that it was compiled with: these are in the
# file for pkg-config alone.
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(HTTPLIB QUIET IMPORTED_TARGET cpp-httplib)
endif()
if(NOT HTTPLIB_FOUND)
  message(WARNING "cpp-httplib or pkg-config is missing: the option --live will say so, and nothing of it is tested")
endif()

# What nearly every file includes, compiled once.
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "// Carries the precompiled header; no code.\n")
add_library(fc_precompiled OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
target_link_libraries(fc_precompiled PRIVATE fc_settings Eigen3::Eigen fmt::fmt)
target_precompile_headers(fc_precompiled PRIVATE
  <algorithm> <array> <cmath> <filesystem> <functional> <limits> <memory> <optional> <span> <string> <vector>
  <Eigen/Core> <Eigen/Geometry> <fmt/format.h>)

# fc_add_library(NAME [UNITY] SOURCES ... LINKS ...): a static library. Eigen and the standard library are read once for all
# (fc_precompiled): half of the time that compiling takes. UNITY: eight files are compiled as one, because most of the rest
# goes into Eigen's templates, which each file would instantiate anew; names must then differ between the files.
function(fc_add_library name)
  cmake_parse_arguments(ARG "UNITY" "" "SOURCES;LINKS" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}/chapters>)
  target_link_libraries(${name} PUBLIC $<BUILD_INTERFACE:fc_settings> ${ARG_LINKS})
  target_precompile_headers(${name} REUSE_FROM fc_precompiled)
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${ARG_UNITY} UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# fc_add_sources(NAME [UNITY] FILES ... LINKS ...): a library of files of the current folder; FILES are names without ".cpp", and
# may have wildcards. Code that only some programs need is such a library, so that the others do not wait for it.
function(fc_add_sources name)
  cmake_parse_arguments(ARG "UNITY" "" "FILES;LINKS" ${ARGN})
  set(unity "")
  if(ARG_UNITY)
    set(unity UNITY)
  endif()
  list(TRANSFORM ARG_FILES APPEND .cpp)
  file(GLOB sources CONFIGURE_DEPENDS ${ARG_FILES})
  list(FILTER sources EXCLUDE REGEX "main\\.cpp$")
  fc_add_library(${name} ${unity} SOURCES ${sources} LINKS ${ARG_LINKS})
  set_property(DIRECTORY APPEND PROPERTY FC_TAKEN ${sources})
  fc_leave_out_studies(${name})
endfunction()

# fc_add_stage(NAME LINKS ...): the stage of the engine that the current chapter teaches, as a library: all files of its
# folder that no fc_add_sources() before has taken, but for the programs' main files.
function(fc_add_stage name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp clear/*.cpp)
  list(FILTER sources EXCLUDE REGEX "main\\.cpp$")
  get_property(taken DIRECTORY PROPERTY FC_TAKEN)
  list(REMOVE_ITEM sources ${taken})
  fc_add_library(${name} UNITY SOURCES ${sources} LINKS ${ARG_LINKS})
  file(GLOB shown show_*.cpp)  # accounts of a frame: each on its own, so that the method's files are compiled together as ever
  set_source_files_properties(${shown} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  fc_install_library(${name} ${folder})
  fc_install_headers(${folder})
endfunction()

# fc_install_library(NAME EXPORTED), fc_install_headers(FOLDER): `cmake --install` puts the library, and the headers of the current
# folder, where find_package(first_contact) finds them, as first_contact::EXPORTED and FOLDER/*.hpp.
function(fc_install_library name exported)
  target_compile_options(${name} INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)  # headers compute bounds, too
  target_include_directories(${name} INTERFACE $<INSTALL_INTERFACE:include/first_contact>)
  set_target_properties(${name} PROPERTIES EXPORT_NAME ${exported})
  install(TARGETS ${name} EXPORT first_contact ARCHIVE DESTINATION lib)
endfunction()
function(fc_install_headers folder)
  install(DIRECTORY . DESTINATION include/first_contact/${folder} FILES_MATCHING PATTERN "*.hpp" PATTERN study EXCLUDE)
endfunction()

# With sanitizers, what measures the engine or makes the drawings' tables is left out, with its tests: it calls functions that
# other tests run there.
function(fc_leave_out_studies name)
  if(FC_SANITIZE AND name MATCHES "_(study|pictures|cones|study_test)$")
    set_target_properties(${name} PROPERTIES EXCLUDE_FROM_ALL ON)
  endif()
endfunction()

# fc_add_program(NAME SOURCE LINKS ...): an executable. The chapter's own is named as its folder.
function(fc_add_program name source)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  add_executable(${name} ${source})
  set_target_properties(${name} PROPERTIES ENABLE_EXPORTS ON)  # to a learner's modules (common/pieces.hpp)
  target_link_libraries(${name} PRIVATE ${ARG_LINKS})
  target_precompile_headers(${name} REUSE_FROM fc_precompiled)
  fc_leave_out_studies(${name})
endfunction()

# fc_add_test(NAME SOURCES ... LINKS ...): a GoogleTest executable whose tests CTest lists one by one. Tests find the
# source tree, the executables and the public test data through the environment variables set here.
#   UNITY     as for libraries: the files are compiled as one, except those after APART, whose names clash with others
#   TOGETHER  CTest runs the tests in one process: a study that all of them read is then made only once. So do all tests with
#             sanitizers, where a process takes a quarter of a second to start
function(fc_add_test name)
  cmake_parse_arguments(ARG "UNITY;TOGETHER" "TIMEOUT" "SOURCES;APART;LINKS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 300)
  endif()
  if(FC_SANITIZE)  # ten times as slow
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}")
  endif()
  add_executable(${name} ${ARG_SOURCES} ${ARG_APART})
  if(ARG_UNITY)
    set_target_properties(${name} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
    set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  target_link_libraries(${name} PRIVATE fc_test_settings ${ARG_LINKS} Eigen3::Eigen fmt::fmt GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM fc_precompiled_tests)
  target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/chapters)
  target_compile_definitions(${name} PRIVATE FC_SOURCE_DIR="${CMAKE_SOURCE_DIR}"
                                             FC_BIN_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  if(FC_SANITIZE)
    target_compile_definitions(${name} PRIVATE FC_SANITIZED)  # tests of many random scenes take fewer
  endif()
  fc_leave_out_studies(${name})
  if(FC_SANITIZE AND name MATCHES "_study_test$")
    return()
  endif()
  set(properties TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT "RC_PARAMS=seed=20080101")
  if(ARG_TOGETHER OR FC_SANITIZE)
    add_test(NAME ${name} COMMAND ${name})
    set_tests_properties(${name} PROPERTIES ${properties})
    if(name MATCHES "_(oracle|random)_")  # the longest: not alone on one core at the end
      set_tests_properties(${name} PROPERTIES COST 500)
    endif()
  else()
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES ${properties})
  endif()
endfunction()
