# Builds and runs the fuzzer, a project of its own, as one test: 20 s, the same seed every time.
find_program(TACTILE_NET_CLANG NAMES clang++ clang++-14 DOC "clang++ with libFuzzer")
set(has_fuzzer FALSE)
if(TACTILE_NET_CLANG)
  set(probe ${CMAKE_CURRENT_BINARY_DIR}/fuzz-probe.cpp)
  file(WRITE ${probe} "extern \"C\" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }\n")
  execute_process(COMMAND ${TACTILE_NET_CLANG} -fsanitize=fuzzer,address ${probe} -o ${probe}.out
                  RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(failed EQUAL 0)
    set(has_fuzzer TRUE)
  endif()
endif()
if(NOT has_fuzzer)
  message(STATUS "The fuzzer of the plan file is left out: it needs clang and libclang-rt-14-dev")
  return()
endif()
add_test(NAME "fuzz: plan file"
  COMMAND ${CMAKE_CTEST_COMMAND}
    --build-and-test ${CMAKE_CURRENT_LIST_DIR} ${CMAKE_CURRENT_BINARY_DIR}/fuzz
    --build-generator ${CMAKE_GENERATOR} --build-project tactile_net_fuzz
    --build-options -DCMAKE_CXX_COMPILER=${TACTILE_NET_CLANG}
    --test-command plan_file_fuzz -seed=1 -max_total_time=20 -runs=200000 -max_len=8192 -timeout=20 -malloc_limit_mb=256
      -artifact_prefix=${CMAKE_CURRENT_BINARY_DIR}/)
set_tests_properties("fuzz: plan file" PROPERTIES LABELS fuzz TIMEOUT 600 COST 900)
