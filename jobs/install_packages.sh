#!/usr/bin/env bash
# Installs the Debian 12 packages that hexfield needs; asks apt for nothing when all are there.
#
#   jobs/install_packages.sh [build|test]     build: the program only; test (default): also the tests' packages
#
# Runs as root, or with sudo. No package from anywhere but Debian's main archive.
set -euo pipefail

build_packages=(
  g++ cmake ninja-build pkg-config
  libopenmpi-dev openmpi-bin libtbb-dev libeigen3-dev petsc-dev libmetis-dev libhdf5-openmpi-dev
  libcli11-dev libspdlog-dev libfmt-dev nlohmann-json3-dev libgmp-dev libboost-dev zlib1g-dev
  coinor-libcbc-dev coinor-libclp-dev
  libopenblas0-pthread # named because PETSc would otherwise run on the reference BLAS
)
test_packages=(
  libgtest-dev libgmock-dev libbenchmark-dev hdf5-tools zstd gmsh clang-format-16
  python3 python3-numpy python3-scipy python3-meshio python3-h5py python3-matplotlib
)

case "${1:-test}" in
  build) packages=("${build_packages[@]}") ;;
  test) packages=("${build_packages[@]}" "${test_packages[@]}") ;;
  *) sed -n '2,6s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "install_packages: all ${#packages[@]} packages are installed"
  exit 0
fi

root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "install_packages: run as root to install: ${missing[*]}" >&2; exit 1; }
  root=(sudo)
fi
echo "install_packages: installing ${missing[*]}"
apt_get() {
  "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3 "$@" </dev/null
}
apt_get update -q
apt_get install -q -y --no-install-recommends "${missing[@]}"
