# cmake -Dprogram=FILE [-Dargument=WORD] -Dline=REGEX -P run_example.cmake: fails unless the program exits with 0 and prints it.
execute_process(COMMAND ${program} ${argument} OUTPUT_VARIABLE printed RESULT_VARIABLE result)
message("${printed}")
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${program} ended with ${result}")
elseif(NOT printed MATCHES "${line}")
  message(FATAL_ERROR "${program} did not print \"${line}\"")
endif()
