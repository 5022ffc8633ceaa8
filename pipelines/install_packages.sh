#!/bin/sh
# install_packages.sh build|test|release: installs the Debian packages that are missing for
# building the tools, for building and testing them, or for building the downloads.
# As root, or through sudo; says so where neither works.
set -eu

build="g++ cmake ninja-build make ccache libgdal-dev libcgal-dev libboost-dev libeigen3-dev
  libhdf5-dev libsqlite3-dev libsqlitecpp-dev libssl-dev libcli11-dev libtomlplusplus-dev
  nlohmann-json3-dev gdal-bin proj-data git help2man python3 pkgconf libpango1.0-dev
  fonts-dejavu-core"
test="libgtest-dev librapidcheck-dev sqlite3 hdf5-tools procps unzip python3-gdal
  python3-h5py python3-matplotlib python3-netcdf4 python3-pandas python3-vtk9 python3-xarray"
release="debootstrap dpkg-dev file patchelf umoci"
# without these their tests are skipped, with a line that says so; Debian 13 has no clang-format-14
optional="clang-format-14 slurm-wlm munge parallel"

case ${1:-} in
  build) wanted=$build optional= ;;
  test) wanted="$build $test" ;;
  release) wanted="$build $release" optional= ;;
  *) echo "usage: install_packages.sh build|test|release" >&2; exit 2 ;;
esac

# missing_of(PACKAGES)
missing_of() {
  for package in $1; do
    dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q '^install ok installed$' ||
      printf ' %s' "$package"
  done
}
missing=$(missing_of "$wanted")
extra=$(missing_of "$optional")
[ -n "$missing$extra" ] || exit 0

echo "Installing Debian packages:$missing$extra"
if [ "$(id -u)" -eq 0 ]; then
  as_root=
elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
  as_root=sudo
elif command -v sudo >/dev/null 2>&1 && [ -t 0 ]; then
  as_root=sudo
else
  [ -n "$missing" ] || exit 0
  echo "These packages are missing and cannot be installed without root or sudo." \
    "Ask an administrator for:" >&2
  echo "  apt-get install --no-install-recommends$missing" >&2
  exit 1
fi
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq
# shellcheck disable=SC2086  # lists of words
[ -z "$missing" ] || $as_root apt-get install -y -qq --no-install-recommends $missing >/dev/null
known=
for package in $extra; do
  ! apt-cache show "$package" >/dev/null 2>&1 || known="$known $package"
done
# shellcheck disable=SC2086
[ -z "$known" ] || $as_root apt-get install -y -qq --no-install-recommends $known >/dev/null ||
  echo "Not installed, so the tests that need them are skipped:$extra"
