#!/usr/bin/env bash
# Installs what is missing, builds with warnings as errors and runs every test.
#
#   jobs/test.sh [ARGUMENTS FOR CTEST...]      for instance: jobs/test.sh -L house
#
# The build is in build/ci. The last line says "test.sh: PASSED ..." or "test.sh: FAILED ..."; the exit status agrees.
set -uo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$top/build/ci"
cores=$(nproc)
step="setting up"
passed=no
started=$SECONDS

finish() {
  local status=$?
  trap - EXIT
  if [ "$passed" = yes ]; then
    echo "test.sh: PASSED in $((SECONDS - started)) s"
  else
    [ $status -ne 0 ] || status=1 # ended by a signal
    echo "test.sh: FAILED (status $status) while $step, after $((SECONDS - started)) s"
  fi
  exit $status
}
trap finish EXIT
set -e

step="installing packages"
"$top/jobs/install_packages.sh" test
step="configuring"
cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHEXFIELD_WERROR=ON -DHEXFIELD_TESTS=ON
step="building"
built=$SECONDS
cmake --build "$build" --parallel "$cores"
echo "test.sh: built in $((SECONDS - built)) s"
step="testing"
ctest --test-dir "$build" --parallel "$cores" --output-on-failure --timeout 900 "$@"
passed=yes
