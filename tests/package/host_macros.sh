#!/bin/sh
# usage: host_macros.sh COMPILER INCLUDE-FOLDER
# Compiles every public header where words are macros, as they are after windows.h. The standard headers come before, which keep
# their own names from macros.
set -eu
compiler=$1
cd "$2"
{
  grep -rhoE '^#include <[a-z_]+(\.h)?>' . | sort -u
  cat <<'MACROS'
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define near
#define far
#define small char
#define interface struct
#define ERROR 0
#define IN
#define OUT
#define OPTIONAL
#define DELETE 0x00010000L
#define DIFFERENCE 11
#define OPAQUE 2
#define TRANSPARENT 1
#define ABSOLUTE 1
#define RELATIVE 2
#define IGNORE 0
#define INFINITE 0xFFFFFFFF
#define DOMAIN 1
#define OVERFLOW 3
#define UNDERFLOW 4
MACROS
  find . -name '*.hpp' | sort | sed 's/.*/#include "&"/'
} | "$compiler" -std=c++20 -fsyntax-only -I. -x c++ -
