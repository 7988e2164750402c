# How targets are compiled, beyond what the build type says.
if(TACTILE_NET_SANITIZE)
  add_link_options(-fsanitize=${TACTILE_NET_SANITIZE})
  # Else Eigen would take memory in one way where it is instrumented and give it back in another where it is not.
  add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=0)
endif()

# NaN and infinity are told from numbers, also in a tree whose flags say -ffast-math or -Ofast: an option comes after the flags.
add_compile_options(-fno-fast-math)

# g++ 12's false alarms in its own headers of strings and regular expressions. Clang knows none of these warnings.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options(-Wno-restrict -Wno-stringop-overflow -Wno-array-bounds)
  if(TACTILE_NET_SANITIZE)
    add_compile_options(-Wno-maybe-uninitialized)
  endif()
endif()

# Where sources are compiled together (CMAKE_UNITY_BUILD), unnamed namespaces of several meet: g++ takes that for a header's mistake,
# and to clang a local name shadows another source's. What shadows a name of its own source is told file by file.
if(CMAKE_UNITY_BUILD)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    add_compile_options(-Wno-subobject-linkage)
  else()
    add_compile_options(-Wno-shadow)
  endif()
endif()

# A second build takes seconds where ccache is installed.
find_program(TACTILE_NET_CCACHE ccache DOC "Launcher of the compiler; not required")
if(PROJECT_IS_TOP_LEVEL AND TACTILE_NET_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros)
  # Trees side by side in build/ that compile a file alike do it once, where no debugger asks in which tree.
  if(CMAKE_BUILD_TYPE STREQUAL Release)
    list(APPEND CMAKE_CXX_COMPILER_LAUNCHER CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1)
  endif()
  list(APPEND CMAKE_CXX_COMPILER_LAUNCHER ${TACTILE_NET_CCACHE})
endif()

# tactile_net_sanitize(target [sanitizer,...]): instruments the target's own sources, and stops at the first finding.
function(tactile_net_sanitize target)
  if(ARGN)
    target_compile_options(${target} PRIVATE -fsanitize=${ARGN} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    # What the address sanitizer or the processor stops at anyhow, and half of the time to compile.
    if("${ARGN}" MATCHES address)
      target_compile_options(${target} PRIVATE -fno-sanitize=alignment,null,object-size,pointer-overflow,vptr)
    endif()
  endif()
endfunction()

# tactile_net_command(target): a part of the command, compiled as the report is.
function(tactile_net_command target)
  tactile_net_sanitize(${target} ${TACTILE_NET_SANITIZE})
  tactile_net_light(${target})
endfunction()

# tactile_net_caller(target): for code that calls the numerics. The standard library checks its indices and empty values. With
# sanitizers it is not optimised, which takes longer than its tests.
function(tactile_net_caller target)
  target_compile_definitions(${target} PRIVATE _GLIBCXX_ASSERTIONS)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O2>)
  if(TACTILE_NET_SANITIZE)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Debug>:-O0>)
  endif()
endfunction()

# tactile_net_light(target): for code that takes longer to compile than it ever runs.
function(tactile_net_light target)
  tactile_net_caller(${target})
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# tactile_net_precompile(target header...) or (target AS other): shares one precompiled header between targets that are compiled
# alike. Never needed: every file includes what it uses.
function(tactile_net_precompile target)
  if(NOT TACTILE_NET_PRECOMPILE)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 1 precompile "" "AS" "")
  if(precompile_AS)
    target_precompile_headers(${target} REUSE_FROM ${precompile_AS})
  else()
    target_precompile_headers(${target} PRIVATE ${precompile_UNPARSED_ARGUMENTS})
  endif()
  # Lets ccache keep what was compiled with it.
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${target} PRIVATE -fpch-preprocess)
  endif()
endfunction()

# tactile_net_unity(target): in a unity build, translation units of at most 48 sources, all of one room, which is the first folder
# of their path. Called where the target is made, after its sources are told. What stays by itself has SKIP_UNITY_BUILD_INCLUSION,
# what goes together otherwise a UNITY_GROUP.
function(tactile_net_unity target)
  set(most 48)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  set(rooms)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR})
    get_source_file_property(apart ${source} SKIP_UNITY_BUILD_INCLUSION)
    get_source_file_property(group ${source} UNITY_GROUP)
    if(apart OR group)
      continue()
    endif()
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR} OUTPUT_VARIABLE path)
    set(room top)
    if(path MATCHES "^([a-z_]+)/")
      set(room ${CMAKE_MATCH_1})
    endif()
    list(APPEND rooms ${room})
    list(APPEND of_${room} ${source})
  endforeach()
  list(REMOVE_DUPLICATES rooms)
  foreach(room IN LISTS rooms)
    list(LENGTH of_${room} count)
    math(EXPR parts "(${count} + ${most} - 1) / ${most}")
    set(number 0)
    foreach(source IN LISTS of_${room})
      math(EXPR part "${number} * ${parts} / ${count} + 1")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${part})
      math(EXPR number "${number} + 1")
    endforeach()
  endforeach()
endfunction()

# tactile_net_link_without_gpl(target): links it without GPL code, whatever FFT and simulator the tree's libraries were built with.
function(tactile_net_link_without_gpl target)
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:tactile_net_without_gpl>)
  if(NOT APPLE)
    target_link_options(${target} PRIVATE -Wl,--as-needed)  # nothing of the shared libraries is needed
  endif()
endfunction()
