# fc_add_exercise(ch01 ex01_door LINKS ...): one exercise. Its parts, of which all but the first are ours:
#
#   exercises/ch01/ex01_door.{hpp,cpp}         the contract, and the learner's code
#   exercises/ch01/ex01_door.demo.cpp          a program that shows what the learner's code does
#   solutions/ch01/ex01_door.cpp
#   tests/exercises/ch01/ex01_door_test.cpp    compiled once, linked with each of the others
#   tests/exercises/ch01/mutants/ex01_door.MISTAKE.cpp    first line: // Caught by: Suite.Test
#
# Targets: ch01_ex01_exercise (the tests on the learner's code) and ch01_ex01_demo, both outside the default build, so that
# a learner's file that does not compile breaks nothing else; and, for CTest, the proof that the tests are worth
# something: every test fails on the stub, every mutant fails the test that its first line names, the solution passes.
#
# The stub's proof is about the file as we wrote it. Once a learner has begun to change it, it is left out.
function(fc_add_exercise chapter name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  string(REGEX MATCH "^ex[0-9]+" number ${name})
  set(id ${chapter}_${number})
  set(tests ${CMAKE_SOURCE_DIR}/tests/exercises/${chapter})
  set(learner ${CMAKE_SOURCE_DIR}/exercises/${chapter}/${name}.cpp)
  set_source_files_properties(${learner} PROPERTIES COMPILE_OPTIONS "-Wno-error;-Wno-unused-parameter")  # it may be unfinished

  add_library(${id}_tests OBJECT EXCLUDE_FROM_ALL ${tests}/${name}_test.cpp)
  fc_exercise_settings(${id}_tests ${chapter} ${ARG_LINKS})

  add_executable(${id}_exercise EXCLUDE_FROM_ALL ${learner})
  fc_exercise_settings(${id}_exercise ${chapter} ${id}_tests ${ARG_LINKS})

  add_executable(${id}_demo EXCLUDE_FROM_ALL ${CMAKE_SOURCE_DIR}/exercises/${chapter}/${name}.demo.cpp ${learner})
  fc_exercise_settings(${id}_demo ${chapter} ${ARG_LINKS})

  add_executable(${id}_solution ${CMAKE_SOURCE_DIR}/solutions/${chapter}/${name}.cpp)
  fc_exercise_settings(${id}_solution ${chapter} ${id}_tests ${ARG_LINKS})
  gtest_discover_tests(${id}_solution TEST_PREFIX "solution.${chapter}." PROPERTIES TIMEOUT 60)
  if(FC_SANITIZE)  # that stubs and mutants fail is proved once, in the other build
    return()
  endif()

  fc_exercise_begun(${learner} begun)
  if(begun)
    message(STATUS "${name} has been begun: the proof that its tests fail on the stub is left out")
  else()
    add_executable(${id}_stub ${learner})
    fc_exercise_settings(${id}_stub ${chapter} ${id}_tests ${ARG_LINKS})
    gtest_discover_tests(${id}_stub TEST_PREFIX "stub_must_fail.${chapter}." PROPERTIES WILL_FAIL TRUE TIMEOUT 60)
  endif()

  file(GLOB mutants CONFIGURE_DEPENDS ${tests}/mutants/${name}.*.cpp)
  foreach(mutant IN LISTS mutants)
    get_filename_component(mistake ${mutant} NAME_WLE)
    string(REPLACE "${name}." "" mistake ${mistake})
    file(STRINGS ${mutant} first LIMIT_COUNT 1)
    string(REGEX REPLACE "^// Caught by: " "" catcher "${first}")
    add_executable(${id}_mutant_${mistake} ${mutant})
    fc_exercise_settings(${id}_mutant_${mistake} ${chapter} ${id}_tests ${ARG_LINKS})
    target_compile_options(${id}_mutant_${mistake} PRIVATE -Wno-unused-parameter)  # often the very mistake
    add_test(NAME mutant_must_fail.${chapter}.${number}.${mistake}  # no such test: nothing fails, and this does
             COMMAND ${id}_mutant_${mistake} --gtest_filter=${catcher})
    set_tests_properties(mutant_must_fail.${chapter}.${number}.${mistake} PROPERTIES WILL_FAIL TRUE TIMEOUT 60)
  endforeach()
endfunction()

function(fc_exercise_settings target chapter)
  target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/chapters ${CMAKE_SOURCE_DIR}/exercises/${chapter})
  target_link_libraries(${target} PRIVATE fc_settings ${ARGN})
  if(NOT target MATCHES "_demo$")
    target_link_libraries(${target} PRIVATE GTest::gtest_main)
  endif()
endfunction()

# Whether the file differs from the committed one, or, committed or not, has no FC_TODO any more. Looked at again when it changes.
function(fc_exercise_begun file result)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(STRINGS ${file} todo REGEX "FC_TODO\\(\"")
  set(changed "")
  find_package(Git QUIET)
  if(GIT_FOUND)  # outside a work tree it prints nothing
    execute_process(COMMAND ${GIT_EXECUTABLE} status --porcelain -- ${file} WORKING_DIRECTORY ${CMAKE_SOURCE_DIR}
                    OUTPUT_VARIABLE changed ERROR_QUIET)
  endif()
  if(todo AND changed STREQUAL "")
    set(${result} FALSE PARENT_SCOPE)
  else()
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()
