#!/usr/bin/env bash
# usage: install_dependencies_test.sh INSTALL-DEPENDENCIES
# Runs the script where every program that it could call is ours, and only says what it was asked.
# shellcheck disable=SC2016  # the programs that it writes expand their own variables
set -euo pipefail
script=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin"
for program in bash sed tr grep cat; do ln -s "$(command -v $program)" "$folder/bin/$program"; done

stub() {
  printf '#!/usr/bin/env bash\n%s\n' "$2" >"$folder/bin/$1"
  chmod +x "$folder/bin/$1"
}
stub env 'while [[ $1 == *=* ]]; do shift; done; exec "$@"'
sed -i "1s|.*|#!$folder/bin/bash|" "$folder/bin/env"
for program in apt-get dnf; do stub $program 'echo "'$program' $*" >>"$LOG"'; done
stub sudo 'echo "sudo" >>"$LOG"; "$@"'
# Installed are all but what MISSING names.
stub dpkg-query '[[ " $MISSING " == *" ${!#} "* ]] || echo installed'
stub rpm '[[ " $MISSING " != *" ${!#} "* ]]'
sed -i "1s|.*|#!$folder/bin/bash|" "$folder"/bin/{apt-get,dnf,sudo,dpkg-query,rpm}

export LOG=$folder/log OS_RELEASE=$folder/os-release MISSING
bad=0
# check NAME EXPECTED-STATUS EXPECTED-IN-LOG-OR-MESSAGE [PACKAGE...]
check() {
  local name=$1 status=$2 expected=$3 code=0 said
  shift 3
  : >"$LOG"
  PATH=$folder/bin "$folder/bin/bash" "$script" "$@" >"$folder/out" 2>"$folder/err" || code=$?
  said=$(cat "$LOG" "$folder/err")
  if [ "$code" -ne "$status" ] || [ -s "$folder/out" ] || [[ $said != *"$expected"* ]]; then
    echo "$name: exit status $code, expected $status with '$expected':"
    cat "$LOG" "$folder/out" "$folder/err"
    bad=1
  fi
}
system() { printf '%s\n' "$@" >"$OS_RELEASE"; }
uname() { printf '#!%s/bin/bash\necho %s\n' "$folder" "$1" >"$folder/bin/uname"; chmod +x "$folder/bin/uname"; }
user() { printf '#!%s/bin/bash\necho %s\n' "$folder" "$1" >"$folder/bin/id"; chmod +x "$folder/bin/id"; }

uname Linux
user 0
system 'ID=debian' 'VERSION_ID="12"'
MISSING=
check "nothing is missing" 0 ""
if [ -s "$LOG" ] || [ -s "$folder/err" ]; then
  echo "something was done where nothing was missing"
  bad=1
fi
MISSING="catch2 shellcheck"
check "Debian" 0 "apt-get install -y -qq --no-install-recommends catch2 shellcheck" shellcheck python3
system 'ID=linuxmint' 'ID_LIKE="ubuntu debian"'
check "a child of Ubuntu" 0 "apt-get install -y -qq --no-install-recommends catch2"
system 'ID=fedora'
MISSING="catch-devel"
check "Fedora" 0 "dnf install -y -q catch-devel"
user 1000
check "Fedora, as a user" 0 "sudo"
mv "$folder/bin/sudo" "$folder/sudo"
check "no sudo" 1 "these packages need root: dnf install catch-devel"
system 'ID=arch'
check "another system" 1 "Eigen 3.4 or 5, Boost 1.74" libfoo-dev
check "another system's own" 1 "by Debian's names: libfoo-dev" libfoo-dev
rm "$OS_RELEASE"
check "a system without a name" 1 "please install"
uname Darwin
stub brew 'if [ "$1" = list ]; then [[ " $MISSING " == *" $3 "* ]] || echo "$3 1.0"; else echo "brew $*" >>"$LOG"; fi'
sed -i "1s|.*|#!$folder/bin/bash|" "$folder/bin/brew"
MISSING="fftw catch2"
check "Homebrew, as a user without sudo" 0 "brew install -q fftw catch2"
exit $bad
