#!/usr/bin/env bash
# Meshes the bundled CAD part on two processes: installs what is missing, builds Release, runs hexfield and
# prints the verdict and where the files are.
#
#   jobs/demo.sh [OUTPUT_DIRECTORY]      default: build/demo
#
# HEXFIELD_BUILD names a finished build to use instead of build/release.
set -euo pipefail
top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
output=$(realpath -m -- "${1:-$top/build/demo}")
part="$top/tests/data/bracket.msh"

if [ -n "${HEXFIELD_BUILD:-}" ]; then
  build=$HEXFIELD_BUILD
else
  build="$top/build/release"
  "$top/jobs/install_packages.sh" build
  cmake -S "$top" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHEXFIELD_TESTS=OFF
  cmake --build "$build" --parallel "$(nproc)"
fi

. "$top/jobs/mpi_environment.sh"
status=0
mpirun -np 2 "$build/apps/hexfield" run "$part" -o "$output" --target-hexes 3000 </dev/null || status=$?

echo
if [ "$status" -eq 0 ]; then
  echo "demo.sh: a complete, valid hex mesh (exit code 0)"
else
  echo "demo.sh: no valid hex mesh (exit code $status); report.json says why and where"
fi
echo "demo.sh: input  $part (geometry: ${part%.msh}.geo)"
for file in hex.vtk singularities.vtk why.vtk report.json run.h5 log.txt; do
  if [ -e "$output/$file" ]; then
    echo "demo.sh: output $output/$file"
  fi
done
exit "$status"
