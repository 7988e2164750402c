# tactile_net_pkg_config(target description [REQUIRES module...]): installs target.pc, for builds that know no CMake.
# They say themselves that they compile C++20: `-std=c++20`.
function(tactile_net_pkg_config target description)
  cmake_parse_arguments(PARSE_ARGV 2 module "" "" REQUIRES)
  list(JOIN module_REQUIRES ", " requires)
  # What lies where is said from the file itself, so that the folder may be moved.
  set(prefix /prefix)
  cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_LIBDIR BASE_DIRECTORY ${prefix} OUTPUT_VARIABLE libraries)
  cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_INCLUDEDIR BASE_DIRECTORY ${prefix} OUTPUT_VARIABLE headers)
  cmake_path(RELATIVE_PATH prefix BASE_DIRECTORY ${libraries}/pkgconfig OUTPUT_VARIABLE up)
  cmake_path(RELATIVE_PATH libraries BASE_DIRECTORY ${prefix})
  cmake_path(RELATIVE_PATH headers BASE_DIRECTORY ${prefix})
  configure_file(module.pc.in ${target}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${target}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
