#!/bin/sh
# new_site.sh NAME GROUND SOURCE [PIPELINES]: a folder NAME with site.toml, Makefile and README.md for
# a slope: GROUND is an elevation model or a contour map, SOURCE a vector file with the release
# polygon, both in a projected CRS. Nothing is copied; site.toml names the files where they are.
set -eu
name=${1:-} ground=${2:-} source=${3:-} pipelines=${4:-$(dirname "$0")}
say() { echo "new-site: $1" >&2; exit "$2"; }

[ -n "$name" ] && [ -n "$ground" ] && [ -n "$source" ] ||
  say "give a folder, the ground and the release polygon: make new-site NAME=../my_slope DEM=dem.tif SOURCE=release.gpkg" 2
case $(basename "$name") in
  *[!A-Za-z0-9_-]*) say "NAME is $name, expected letters (a to z), digits, _ and -" 2 ;;
esac
[ -d "$(dirname "$name")" ] || say "$(dirname "$name"): there is no such folder to make $(basename "$name") in" 1
[ ! -e "$name" ] || say "$(realpath "$name") exists already: choose another NAME, or move it away" 1
for file in "$ground" "$source"; do [ -f "$file" ] || say "$file: there is no such file, seen from $PWD: give its whole path" 1; done

# A raster or a vector file? What GDAL opens as a raster is taken as an elevation model.
if gdalinfo "$ground" >/dev/null 2>&1; then key=dem
elif ogrinfo -so "$ground" >/dev/null 2>&1; then key=contours
else say "$ground: neither an elevation raster nor a vector file that GDAL can read (gdalinfo, ogrinfo)" 1; fi
ogrinfo -so "$source" >/dev/null 2>&1 || say "$source: not a vector file that GDAL can read (ogrinfo)" 1

part=$(mktemp -d "$(dirname "$name")/.new-site.XXXXXX")
trap 'rm -rf "$part"' EXIT
seen_from_site() { realpath -m --relative-to="$name" "$1"; }

cat >"$part/site.toml" <<END
# Everything here is assumed until somebody has measured it.
# All keys with unit, default and range: docs/site-file.md
[site]
name = "$(basename "$name")"

[terrain]
$key = "$(seen_from_site "$ground")"
# cell_size_m = 5

[source]
polygon_file = "$(seen_from_site "$source")"
failure_surface = "normal_depth"
depth_m = 5

# Joint sets cut the mass into blocks: dip and dip direction from the field.
[joints.rear]
dip_deg = 80
dip_direction_deg = 0
spacing_m = 6

[joints.lateral]
dip_deg = 85
dip_direction_deg = 90
spacing_m = 6

[material.rock]
density_kg_m3 = 2600
friction_deg = 30
cor = 0.3

[ground.slope]
friction_deg = 28
cor = 0.3

[solver]
duration_s = 30

# A fence, or any line to know the arrivals at:
# [fence.road]
# line = [[x, y], [x, y]]
# height_m = 4
END
cat >"$part/Makefile" <<END
# \`make help\` lists the targets, site.toml says what is computed.
include $(seen_from_site "$pipelines")/site.mk
END
cat >"$part/README.md" <<END
# $(basename "$name")

| Data | Origin and licence | Attribution |
|---|---|---|
| \`$(seen_from_site "$ground")\` | | |
| \`$(seen_from_site "$source")\` | | |

## What is measured

## What is assumed
- depth, joints, friction and restitution in \`site.toml\`: the template's, for no slope in particular
END
chmod 755 "$part"
mv -T "$part" "$name"
trap - EXIT
name=$(realpath "$name")
echo "$name is made: edit $name/site.toml (source, joints, friction), then make -C $name"
