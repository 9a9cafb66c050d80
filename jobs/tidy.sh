#!/usr/bin/env bash
# Runs clang-tidy 16 with the checks of .clang-tidy over the library and the program.
#
#   jobs/tidy.sh [FILES...]        default: every .cpp under src and apps (about 10 s of processor time each)
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build="$top/build/tidy"
command -v clang-tidy-16 >/dev/null || { echo "tidy.sh: install clang-tidy-16 first" >&2; exit 1; }
if [ $# -eq 0 ]; then
  mapfile -d '' -t files < <(find "$top/src" "$top/apps" -name '*.cpp' -print0 | sort -z)
else
  files=("$@")
fi
cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release >/dev/null
printf '%s\0' "${files[@]}" | xargs -0 -n 1 -P "$(nproc)" clang-tidy-16 -p "$build" --quiet 2>/dev/null
echo "tidy.sh: ${#files[@]} files looked at"
