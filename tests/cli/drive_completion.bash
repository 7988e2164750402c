#!/usr/bin/env bash
# usage: drive_completion.bash SCRIPT PROGRAM WORD...
# What the completion of bash offers for the last word, a line each.
# shellcheck disable=SC1090,SC2034
source "$1"
shift
COMP_WORDS=("$@")
COMP_CWORD=$(($# - 1))
COMPREPLY=()
_tactile_net
[ ${#COMPREPLY[@]} -eq 0 ] || printf '%s\n' "${COMPREPLY[@]}"
