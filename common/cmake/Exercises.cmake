# fc_add_exercise(ch01 ex01_door LINKS ... DEMO ...): one exercise. LINKS is what its tests and its code need, and no more: it
# is what a learner's first check has to wait for. DEMO is what the demo needs beyond that. Its parts, all but the
# first of them ours:
#
#   exercises/ch01/ex01_door.{hpp,cpp}         the contract, and the learner's code
#   exercises/ch01/ex01_door.demo.cpp          a program that shows what the learner's code does
#   solutions/ch01/ex01_door.cpp
#   tests/exercises/ch01/ex01_door_test.cpp    compiled once, linked with each of the others
#   tests/exercises/ch01/mutants/ex01_door.MISTAKE.cpp    first line: // Caught by: Suite.Test
#                                   ....MISTAKE.change   the same as a change of the solution: see make_mutants.py
#
# An exercise that is a piece of the engine (common/pieces.hpp) has, in place of the demo or besides it,
#
#   exercises/ch01/ex06_closest_point.piece.cpp    exports the learner's function; its first line: // See: SCENE
#
# and the targets ch01_ex06_piece (bin/../pieces/ch01_ex06.so of the learner's file) and ch01_ex06_book_piece (the same of the
# solution, in pieces/book/, for the tests).
#
# Targets: ch01_ex01_exercise (the tests on the learner's code) and ch01_ex01_demo, both outside the default build, so that
# a learner's file that does not compile breaks nothing else; and, for CTest, the proof that the tests are worth
# something: every test fails on the stub, every mutant fails the test that its first line names, the solution passes.
#
# The stub's proof is about the file as committed, so it has a copy of its own, which is made anew until somebody has
# begun to write in the file. Where there is no copy (writing began before the first configuration), the proof is left out. The
# learner's file is no input of the configuration: that would cost seconds whenever it changes.
function(fc_add_exercise chapter name)
  cmake_parse_arguments(ARG "" "" "LINKS;DEMO" ${ARGN})
  string(REGEX MATCH "^ex[0-9]+" number ${name})
  set(id ${chapter}_${number})
  set(tests ${CMAKE_SOURCE_DIR}/tests/exercises/${chapter})
  set(learner ${CMAKE_SOURCE_DIR}/exercises/${chapter}/${name}.cpp)
  set(stub ${CMAKE_CURRENT_BINARY_DIR}/stubs/${chapter}/${name}.cpp)
  set_source_files_properties(${learner} ${stub} PROPERTIES COMPILE_OPTIONS "-Wno-error;-Wno-unused-parameter")  # unfinished

  add_library(${id}_tests OBJECT EXCLUDE_FROM_ALL ${tests}/${name}_test.cpp)
  fc_exercise_settings(${id}_tests ${chapter} ${ARG_LINKS})

  add_executable(${id}_exercise EXCLUDE_FROM_ALL ${learner})
  fc_exercise_settings(${id}_exercise ${chapter} ${id}_tests ${ARG_LINKS})

  set(piece ${CMAKE_SOURCE_DIR}/exercises/${chapter}/${name}.piece.cpp)
  set(demo ${CMAKE_SOURCE_DIR}/exercises/${chapter}/${name}.demo.cpp)
  if(EXISTS ${piece})
    fc_add_piece(${id} ${chapter} ${id}_piece ${CMAKE_BINARY_DIR}/pieces ${learner} ${piece})
    set_target_properties(${id}_piece PROPERTIES EXCLUDE_FROM_ALL ON)
    fc_add_piece(${id} ${chapter} ${id}_book_piece ${CMAKE_BINARY_DIR}/pieces/book ${CMAKE_SOURCE_DIR}/solutions/${chapter}/${name}.cpp ${piece})
  endif()
  if(EXISTS ${demo})
    add_executable(${id}_demo EXCLUDE_FROM_ALL ${demo} ${learner})
    fc_exercise_settings(${id}_demo ${chapter} ${ARG_LINKS} ${ARG_DEMO})
  endif()

  add_executable(${id}_solution ${CMAKE_SOURCE_DIR}/solutions/${chapter}/${name}.cpp)
  fc_exercise_settings(${id}_solution ${chapter} ${id}_tests ${ARG_LINKS})
  if(FC_SANITIZE)  # that stubs and mutants fail is proved once, in the other build
    add_test(NAME solution.${chapter}.${number} COMMAND ${id}_solution)
    set_tests_properties(solution.${chapter}.${number} PROPERTIES TIMEOUT 600)
    return()
  endif()
  gtest_discover_tests(${id}_solution TEST_PREFIX "solution.${chapter}." PROPERTIES TIMEOUT 60)

  set(copy ${CMAKE_COMMAND} -D FROM=${learner} -D TO=${stub} -P ${CMAKE_SOURCE_DIR}/common/cmake/copy_stub.cmake)
  execute_process(COMMAND ${copy})
  if(EXISTS ${stub})
    add_custom_command(OUTPUT ${stub}.looked_at DEPENDS ${learner} BYPRODUCTS ${stub} VERBATIM
                       COMMAND ${copy} COMMAND ${CMAKE_COMMAND} -E touch ${stub}.looked_at)
    add_executable(${id}_stub ${stub} ${stub}.looked_at)
    fc_exercise_settings(${id}_stub ${chapter} ${id}_tests ${ARG_LINKS})
    gtest_discover_tests(${id}_stub TEST_PREFIX "stub_must_fail.${chapter}." PROPERTIES WILL_FAIL TRUE TIMEOUT 60)
  else()
    message(STATUS "${name} has been begun: the proof that its tests fail on the stub is left out")
  endif()

  # All mutants are one program: FC_MUTANT says which of them the tests meet.
  file(GLOB mutants CONFIGURE_DEPENDS ${tests}/mutants/${name}.*.cpp ${tests}/mutants/${name}.*.change)
  if(NOT mutants)
    return()
  endif()
  set(solution ${CMAKE_SOURCE_DIR}/solutions/${chapter}/${name}.cpp)
  set(contract ${CMAKE_SOURCE_DIR}/exercises/${chapter}/${name}.hpp)
  set(changed ${mutants})
  foreach(mutant IN LISTS mutants)
    file(STRINGS ${mutant} changes REGEX "^// Changes: ")
    string(REPLACE "// Changes: " "${CMAKE_SOURCE_DIR}/" changes "${changes}")  # none: the solution is changed
    list(APPEND changed ${changes})
    file(STRINGS ${mutant} catcher LIMIT_COUNT 1)
    string(REGEX REPLACE "^// Caught by: " "" catcher "${catcher}")
    get_filename_component(mistake ${mutant} NAME_WLE)
    string(REPLACE "${name}." "" mistake ${mistake})
    set(test mutant_must_fail.${chapter}.${number}.${mistake})  # no such test: nothing fails, and this does
    add_test(NAME ${test} COMMAND ${id}_mutants --gtest_filter=${catcher})
    set_tests_properties(${test} PROPERTIES WILL_FAIL TRUE TIMEOUT 60 ENVIRONMENT FC_MUTANT=${mistake})
  endforeach()
  set(source ${CMAKE_CURRENT_BINARY_DIR}/mutants/${chapter}/${name}.cpp)
  set(tool ${CMAKE_SOURCE_DIR}/common/cmake/make_mutants.py)
  list(REMOVE_DUPLICATES changed)
  add_custom_command(OUTPUT ${source} VERBATIM
                     DEPENDS ${contract} ${solution} ${changed} ${tool}
                     COMMAND python3 ${tool} ${CMAKE_SOURCE_DIR} ${contract} ${solution} ${source} ${mutants})
  add_executable(${id}_mutants ${source})
  fc_exercise_settings(${id}_mutants ${chapter} ${id}_tests ${ARG_LINKS})
  target_compile_options(${id}_mutants PRIVATE -Wno-unused-parameter)  # often the very mistake
endfunction()

# A module that the programs load: the function of `source`, exported by `piece`. It finds the engine's functions in the program.
function(fc_add_piece id chapter target folder source piece)
  add_library(${target} MODULE ${source} ${piece})
  fc_exercise_settings(${target} ${chapter})
  foreach(library Eigen3::Eigen fmt::fmt)  # whose headers it may include
    if(TARGET ${library})
      target_link_libraries(${target} PRIVATE ${library})
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES PREFIX "" SUFFIX .so OUTPUT_NAME ${id} LIBRARY_OUTPUT_DIRECTORY ${folder})
  if(APPLE)
    target_link_options(${target} PRIVATE -undefined dynamic_lookup)
  endif()
endfunction()

function(fc_exercise_settings target chapter)
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/chapters ${CMAKE_SOURCE_DIR}/exercises/${chapter})
  target_link_libraries(${target} PRIVATE fc_settings ${ARGN})
  if(NOT target MATCHES "_(demo|piece)$")
    target_link_libraries(${target} PRIVATE GTest::gtest_main)
  endif()
  if(TARGET fc_precompiled_tests AND target MATCHES "_tests$")  # a learner's first check takes longer, all later ones less
    target_link_libraries(${target} PRIVATE fc_test_settings Eigen3::Eigen fmt::fmt GTest::gmock)
    target_precompile_headers(${target} REUSE_FROM fc_precompiled_tests)
  endif()
  if(TARGET fc_precompiled AND target MATCHES "_(solution|stub|mutants)$")
    target_link_libraries(${target} PRIVATE Eigen3::Eigen fmt::fmt)
    target_precompile_headers(${target} REUSE_FROM fc_precompiled)
  endif()
endfunction()
