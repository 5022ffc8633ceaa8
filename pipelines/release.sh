#!/bin/sh
# The downloads: Debian packages, a tarball for Debian 12 and later that needs no root, a
# container image (OCI), the packages inside them (SPDX) and digests.
#   sh pipelines/release.sh [FOLDER]      FOLDER: build/download
# Builds the tools first. Needs root for the image's file system. tests/try_release.sh tries them.
set -eu
cd "$(dirname "$0")/.."
mkdir -p "${1:-build/download}"
out=$(realpath "${1:-build/download}")
refuse() { echo "release.sh: $1" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] || refuse "needs root, for the file system of the image"
sh pipelines/install_packages.sh release
work=$(mktemp -d)
trap 'umount "$work/root/proc" 2>/dev/null || true; rm -rf "$work"' EXIT

cmake --preset release -DTALUS_TESTS=OFF -DTALUS_BENCH=OFF -B build/demo >/dev/null
cmake --build build/demo --target package >/dev/null
version=$(build/demo/tools/talus-dda --version | cut -d' ' -f2)
rm -f "$out"/talus[-_]* "$out"/python3-talus_* "$out/SHA256SUMS"
cp build/demo/talus_*.deb build/demo/python3-talus_*.deb "$out/"

# parts_of FILE: its bill of materials from lines "package version" of Debian
parts_of() {
  python3 pipelines/bill_of_materials.py "$1" "$version" "$(git log -1 --format=%cs)" \
    >"$out/$1.spdx.json"
}

# --- tarball: the package's files with the libraries that they load, except the C library ---
name=talus-$version-linux-$(uname -m)
dpkg-deb -x "$out"/talus_*.deb "$work/deb"
tree=$work/$name
mv "$work/deb/usr" "$tree"
mkdir -p "$tree/lib/talus" "$tree/share/fonts" "$tree/share/gdal"
mv "$tree"/bin/talus-* "$tree/lib/talus/"
cp /usr/bin/gdalinfo /usr/bin/ogrinfo "$tree/lib/talus/"  # talus new asks them
ldd "$tree"/lib/talus/* | sed -n 's/.*=> \(\/[^ ]*\) .*/\1/p' | sort -u |
  grep -Ev '/(libc|libm|libdl|librt|libpthread|libresolv|ld-linux-x86-64)\.so' >"$work/libraries"
while read -r library; do cp -L "$library" "$tree/lib/"; done <"$work/libraries"
patchelf --force-rpath --set-rpath '$ORIGIN/..' "$tree"/lib/talus/*
cp -r /usr/share/proj "$tree/share/"
cp -r /usr/share/gdal/. "$tree/share/gdal/"
cp /usr/share/fonts/truetype/dejavu/*.ttf "$tree/share/fonts/"
cat >"$tree/share/fonts/fonts.conf" <<'END'
<?xml version="1.0"?>
<!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig><dir prefix="relative">.</dir><cachedir prefix="xdg">fontconfig</cachedir></fontconfig>
END
cat >"$tree/bin/start" <<'END'
#!/bin/sh
# Starts the tool by whose name it is called, with the libraries and data of this folder.
here=$(dirname "$(dirname "$(realpath "$0")")")
export PROJ_DATA="$here/share/proj" GDAL_DATA="$here/share/gdal"
export FONTCONFIG_FILE="$here/share/fonts/fonts.conf" GDAL_DRIVER_PATH=disable
exec "$here/lib/talus/${0##*/}" "$@"
END
chmod 755 "$tree/bin/start"
for tool in "$tree"/lib/talus/*; do ln -s start "$tree/bin/${tool##*/}"; done
tar --sort=name --owner=0 --group=0 --numeric-owner --mtime="@$(git log -1 --format=%ct)" \
  -C "$work" -cJf "$out/$name.tar.xz" "$name"
while read -r library; do
  dpkg -S "$(realpath "$library")" 2>/dev/null || dpkg -S "$library"
done <"$work/libraries" | sed 's/:.*//' | sort -u |
  xargs dpkg-query -W -f '${Package} ${Version}\n' | parts_of "$name"

# --- image: the package on a bare Debian 12 ---
name=talus-$version-image
sh tests/bare_system.sh "$work/root"
cp "$out"/talus_*.deb "$work/root/"
mount -t proc proc "$work/root/proc"
chroot "$work/root" sh -c 'export DEBIAN_FRONTEND=noninteractive && apt-get update -qq &&
  apt-get install -y -qq --no-install-recommends /talus_*.deb make gdal-bin' >"$work/log" 2>&1 ||
  { tail "$work/log" >&2; exit 1; }
umount "$work/root/proc"
chroot "$work/root" dpkg-query -W -f '${Package} ${Version}\n' | parts_of "$name"
(cd "$work/root" && rm -rf talus_*.deb var/lib/apt/lists/* var/cache/apt/* var/log/* tmp/* \
  usr/share/man/* etc/apt/sources.list etc/apt/apt.conf.d/* etc/resolv.conf)
umoci init --layout "$work/image"
umoci new --image "$work/image:$version"
umoci insert --image "$work/image:$version" "$work/root" / >/dev/null
umoci config --image "$work/image:$version" --architecture amd64 --os linux \
  --config.env PATH=/usr/bin:/bin \
  --config.entrypoint talus --config.cmd help --config.workingdir /work
umoci gc --layout "$work/image"
tar -C "$work/image" -cf "$out/$name.tar" .

(cd "$out" && sha256sum talus[-_]* python3-talus_* >SHA256SUMS)
echo "$out:"
(cd "$out" && du -h --apparent-size talus[-_]* python3-talus_*)
