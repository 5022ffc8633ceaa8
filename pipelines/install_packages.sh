#!/bin/sh
# install_packages.sh build|test: installs the Debian packages that are missing for building the
# tools, or for building and testing them. As root, or through sudo; says so where neither works.
set -eu

build="g++ cmake ninja-build make ccache libgdal-dev libcgal-dev libeigen3-dev libhdf5-dev
  libsqlite3-dev libsqlitecpp-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev gdal-bin proj-data git help2man"
test="libgtest-dev librapidcheck-dev clang-format-14 python3 sqlite3 hdf5-tools procps slurm-wlm munge parallel"

case ${1:-} in
  build) wanted=$build ;;
  test) wanted="$build $test" ;;
  *) echo "usage: install_packages.sh build|test" >&2; exit 2 ;;
esac

missing=
for package in $wanted; do
  dpkg-query -W -f '${Status}\n' "$package" 2>/dev/null | grep -q '^install ok installed$' ||
    missing="$missing $package"
done
[ -n "$missing" ] || exit 0

echo "Installing Debian packages:$missing"
if [ "$(id -u)" -eq 0 ]; then
  as_root=
elif command -v sudo >/dev/null 2>&1 && sudo -n true 2>/dev/null; then
  as_root=sudo
elif command -v sudo >/dev/null 2>&1 && [ -t 0 ]; then
  as_root=sudo
else
  echo "These packages are missing and cannot be installed without root or sudo. Ask an administrator for:" >&2
  echo "  apt-get install --no-install-recommends$missing" >&2
  exit 1
fi
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -qq
# shellcheck disable=SC2086  # a list of words
$as_root apt-get install -y -qq --no-install-recommends $missing >/dev/null
