#!/bin/sh
# try_release.sh FOLDER: installs each file that pipelines/release.sh made in FOLDER on a bare Debian
# 12 and computes a sample site there: the package, the tarball, the image. Prints how long the site
# took. Needs root, debootstrap and umoci. Not part of the normal tests.
set -eu
files=$(realpath "$1")
tests=$(realpath "$(dirname "$0")")
[ "$(id -u)" -eq 0 ] || { echo "try_release.sh: needs root, for chroot" >&2; exit 1; }
work=$(mktemp -d)
trap 'umount "$work"/*/proc "$work"/*/rootfs/proc 2>/dev/null || true; rm -rf "$work"' EXIT
(cd "$files" && sha256sum --quiet -c SHA256SUMS)

# inside ROOT COMMAND
inside() {
  mount -t proc proc "$1/proc"  # loaders find the folder of a program there
  chroot "$1" sh -c "$2" >"$work/log" 2>&1 ||
    { tail -n 40 "$work/log" >&2; echo "FAILED in $1: $2" >&2; exit 1; }
  umount "$1/proc"
}
# computed WHAT ROOT SITE: the site by talus run, and how long it took
computed() {
  before=$(date +%s)
  inside "$2" "export PATH=/opt/talus/bin:\$PATH; cp -r $3 /tmp/site && talus run /tmp/site"
  for result in report.html site.qgz maps/velocity.tif; do
    [ -s "$2/tmp/site/out/$result" ] || { echo "$1: there is no $result" >&2; exit 1; }
  done
  echo "$1: the site took $(($(date +%s) - before)) s"
}

sh "$tests/bare_system.sh" "$work/bare"
cp -a "$work/bare" "$work/package"
cp "$files"/talus_*.deb "$work/package/"
inside "$work/package" "apt-get update -qq &&
  apt-get install -y -qq --no-install-recommends /talus_*.deb make gdal-bin"
computed package "$work/package" /usr/share/talus/sample_sites/designed
inside "$work/package" "test -s /usr/share/qgis/python/plugins/talus/metadata.txt &&
  ls /usr/share/talus/talus-qgis-*.zip &&
  test -s /usr/share/talus/report/texts.toml && test -s /usr/share/talus/report/project.qgs"

# The tarball needs make; what it was given at build time is not there.
cp -a "$work/bare" "$work/tarball"
mkdir -p "$work/tarball/opt/talus"
tar -xJf "$files"/talus-*-linux-*.tar.xz --strip-components=1 -C "$work/tarball/opt/talus"
cp /usr/bin/make "$work/tarball/usr/bin/"
computed tarball "$work/tarball" /opt/talus/share/talus/sample_sites/designed
for tool in "$work"/tarball/opt/talus/bin/talus-*; do
  inside "$work/tarball" "/opt/talus/bin/${tool##*/} --version"
done
inside "$work/tarball" "export PATH=/opt/talus/bin:\$PATH; cd /tmp && talus new slope site/out/trn.tif"

mkdir "$work/layout"
tar -xf "$files"/talus-*-image.tar -C "$work/layout"
umoci unpack --image "$work/layout:$(umoci list --layout "$work/layout")" "$work/image"
computed image "$work/image/rootfs" /usr/share/talus/sample_sites/designed

# Each makes the same maps.
for one in tarball image/rootfs; do
  cmp "$work/package/tmp/site/out/maps/velocity.tif" "$work/$one/tmp/site/out/maps/velocity.tif"
done
