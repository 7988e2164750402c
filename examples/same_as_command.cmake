# cmake -Dexample=FILE -Dcommand=FILE -Dscene=FILE -P same_as_command.cmake: fails unless `example SCENE` prints
# what `command run SCENE` prints, durations and the columns' widths aside.
execute_process(COMMAND ${example} ${scene} OUTPUT_VARIABLE one COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${command} run ${scene} OUTPUT_VARIABLE other COMMAND_ERROR_IS_FATAL ANY)
foreach(printed IN ITEMS one other)
  string(REGEX REPLACE "[0-9.e+-]+ (ns|us|ms|s)" "TIME" ${printed} "${${printed}}")
  string(REGEX REPLACE " +" " " ${printed} "${${printed}}")
endforeach()
if(NOT one STREQUAL other)
  message(FATAL_ERROR "the example prints\n${one}\nthe command prints\n${other}")
endif()
