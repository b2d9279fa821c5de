# cmake -D FROM=exercises/... -D TO=... -P copy_stub.cmake: copies an exercise's file until somebody has begun to write in
# it, that is, while it has an FC_TODO and equals the committed one.
file(STRINGS ${FROM} todo REGEX "FC_TODO\\(\"")
get_filename_component(folder ${FROM} DIRECTORY)
set(changed "")
find_program(git git)
if(git)  # outside a work tree it prints nothing
  execute_process(COMMAND ${git} status --porcelain -- ${FROM} WORKING_DIRECTORY ${folder} OUTPUT_VARIABLE changed ERROR_QUIET)
endif()
if(todo AND changed STREQUAL "")
  configure_file(${FROM} ${TO} COPYONLY)
endif()
