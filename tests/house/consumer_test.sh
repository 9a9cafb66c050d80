#!/usr/bin/env bash
# consumer_test.sh BUILD_DIRECTORY SCRATCH_DIRECTORY: installs the build into the scratch directory, builds a
# project that knows nothing but find_package(hexfield), and runs it.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
scratch=$2
rm -rf "$scratch"
cmake --install "$1" --prefix "$scratch/prefix" >/dev/null
# Nothing installed may point back into the checkout or the build.
if grep -rlF -e "$1" -e "$(cd "$here/../.." && pwd)" "$scratch/prefix/lib" --include='*.cmake'; then
  echo "the installed package names the build or source directory" >&2
  exit 1
fi
cmake -S "$here/consumer" -B "$scratch/build" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/prefix" -DCMAKE_BUILD_TYPE=Release >/dev/null
cmake --build "$scratch/build" >/dev/null
"$scratch/build/consumer"
if [ -x "$scratch/prefix/bin/hexfield" ]; then
  "$scratch/prefix/bin/hexfield" --version
fi
echo "ok: a project of its own builds on the installed package"
