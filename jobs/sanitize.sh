#!/usr/bin/env bash
# Builds with the address and undefined-behaviour sanitizers and runs the unit tests of every module.
#
#   jobs/sanitize.sh [ARGUMENTS FOR CTEST...]        default: all tests but those of the house
#
# Leaks are not looked for: the MPI library holds memory until its modules are unloaded.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$top/build/sanitize"
"$top/jobs/install_packages.sh" test
cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DHEXFIELD_SANITIZE=ON -DHEXFIELD_TESTS=ON
cmake --build "$build" --parallel "$(nproc)"
export ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=print_stacktrace=1
[ $# -gt 0 ] || set -- -LE 'house|python-post|jobs'
ctest --test-dir "$build" --parallel "$(nproc)" --output-on-failure --timeout 1800 "$@"
