#!/bin/sh
# usage: pkg_config.sh COMPILER FOLDER-OF-PC-FILES "MODULE..." SOURCE PROGRAM [ARGUMENT...]
# Compiles the source by what pkg-config says of the modules, and runs it.
set -eu
compiler=$1 modules=$3 source=$4 program=$5
PKG_CONFIG_PATH=$2
export PKG_CONFIG_PATH
shift 5
(
  # Folders may have blanks, which pkg-config writes for a shell.
  # shellcheck disable=SC2086  # several modules
  eval "set -- $(pkg-config --cflags --libs $modules)"
  "$compiler" -std=c++20 "$source" "$@" -o "$program"
)
"$program" "$@"
