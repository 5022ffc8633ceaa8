#!/bin/sh
# new_site.sh NAME GROUND [SOURCE [PIPELINES [TOOLS]]]: a folder NAME with site.toml, site.gpkg,
# Makefile and README.md for a slope: GROUND is an elevation model or a contour map, SOURCE a vector
# file with the release polygon, both in a projected CRS. The ground is not copied; site.toml names
# it where it is. The source becomes a layer of site.gpkg; without one it is drawn there. The tools
# (folder TOOLS/, or on the search path) measure the slope, and joint sets are assumed to fit.
set -eu
name=${1:-} ground=${2:-} source=${3:-} pipelines=${4:-$(dirname "$0")} tools=${5:-}
say() { echo "new-site: $1" >&2; exit "$2"; }

[ -n "$name" ] && [ -n "$ground" ] ||
  say "give a folder and the ground, and the release polygon where there is one: make new-site \
NAME=../my_slope DEM=dem.tif SOURCE=release.gpkg" 2
case $(basename "$name") in
  *[!A-Za-z0-9_-]*) say "NAME is $name, expected letters (a to z), digits, _ and -" 2 ;;
esac
[ -d "$(dirname "$name")" ] || say "$(dirname "$name"): there is no such folder to make $(basename \
"$name") in" 1
[ ! -e "$name" ] || say "$(realpath "$name") exists already: choose another NAME, or move it away" 1
for file in "$ground" ${source:+"$source"}; do [ -f "$file" ] || say "$file: there is no such \
file, seen from $PWD: give its whole path" 1; done

# A raster or a vector file? What GDAL opens as a raster is taken as an elevation model.
if gdalinfo "$ground" >/dev/null 2>&1; then key=dem
elif ogrinfo -so "$ground" >/dev/null 2>&1; then key=contours
else say "$ground: neither an elevation raster nor a vector file that GDAL can read (gdalinfo, \
ogrinfo)" 1; fi
[ -z "$source" ] || ogrinfo -so "$source" >/dev/null 2>&1 || say "$source: not a vector file that \
GDAL can read (ogrinfo)" 1

part=$(mktemp -d "$(dirname "$name")/.new-site.XXXXXX")
trap 'rm -rf "$part"' EXIT
seen_from_site() { realpath -m --relative-to="$name" "$1"; }

[ -z "$tools" ] || tools=$(realpath -m "$tools")/

head_of_site() {
  cat <<END
# Everything here is assumed until somebody has measured it.
# All keys with unit, default and range: docs/reference/site-file.md
[site]
name = "$(basename "$name")"
END
  [ -z "$layers" ] || cat <<END
# Source, fences, objects, grounds, forest and release points are drawn and edited there:
layers = "site.gpkg"
END
  cat <<END

[terrain]
$key = "$(seen_from_site "$ground")"
# cell_size_m = 5

[source]
END
  [ -n "$layers" ] || echo "polygon_file = \"$(seen_from_site "$source")\""
}
rest_of_site() {
  cat <<END

[material.rock]
density_kg_m3 = 2600
friction_deg = 30
cor = 0.3

# What the mass slides and falls on; the failure surface needs a joint set that is steeper.
[ground.slope]
friction_deg = 28
cor = 0.3

[solver]
duration_s = 60
start_jitter_m_s = 1e-4       # speed at the start, drawn: runs of other seeds differ (make RUNS=10)
# friction_scatter_deg = 2    # so does friction that is drawn for each run

END
  if [ -n "$layers" ]; then
    echo "# A fence, or any line to know the arrivals at: draw it in the layer fences of site.gpkg."
  else
    cat <<END
# A fence, or any line to know the arrivals at:
# [fence.road]
# line = [[x, y], [x, y]]
# height_m = 4
END
  fi
}
# Where the slope could not be measured, or no plane can daylight.
joints_for_no_slope() {
  cat <<END

# Joint sets cut the mass into blocks: dip, dip direction and spacing from the field.
# These are ASSUMED, for no slope in particular.
[joints.rear]
dip_deg = 80
dip_direction_deg = 0
spacing_m = 6

[joints.lateral]
dip_deg = 85
dip_direction_deg = 90
spacing_m = 6
END
}
hollow() {
  cat <<END
# THE SLOPE WAS NOT MEASURED. Below is a hollow with a step at its foot: most of what lies in it
# will stay. Give the joint sets of the slope, one of which dips out of it, and then
# failure_surface = "daylighting".
failure_surface = "normal_depth"
depth_m = 5
END
}
# The flags of a make that called this are not those of the makes here.
measure_slope() {
  unset MAKEFLAGS MFLAGS MAKELEVEL
  make -s -C "$part" OUT=.slope BIN="$tools" terrain >/dev/null &&
    "${tools}talus-source" "$part/site.toml" --trn "$part/.slope/trn.tif" \
      --assume-joints "$part/.joints" --no-db >/dev/null
}

# Make parts names at blanks, and takes # $ % : for orders: a path with any of them is reached by a
# link.
rules=$(seen_from_site "$pipelines")
case $rules in
  *[!A-Za-z0-9_./,@+=-]*)
    ln -s "$rules" "$part/.pipelines" ||
      say "the path of the pipelines, $rules, holds letters that make does not take, and no link \
can be made here" 1
    rules=.pipelines ;;
esac
cat >"$part/Makefile" <<END
# \`make help\` lists the targets, site.toml says what is computed.
include $rules/site.mk
END
layers=
if ! "${tools}talus-source" --help >/dev/null 2>&1; then
  [ -n "$source" ] || say "the tools are not built (sh pipelines/demo.sh), so no layer can be made \
to draw the source in: give SOURCE" 1
  echo "new-site: the tools are not built (sh pipelines/demo.sh): joint sets are not fitted to the \
slope" >&2
elif "${tools}talus-site" --new-layers "$part/site.gpkg" --crs-of "$ground" \
  ${source:+--source "$source"} --no-db >/dev/null 2>"$part/.log"; then
  layers=yes
else
  cat "$part/.log" >&2
  [ -n "$source" ] || exit 1
  echo "new-site: no site.gpkg can be made, for the reason above: site.toml names the release \
polygon where it is" >&2
fi
{ head_of_site; rest_of_site; } >"$part/site.toml"
if ! "${tools}talus-source" --help >/dev/null 2>&1; then
  :
elif [ -z "$source" ]; then
  echo "new-site: there is no source yet: draw it in the layer source of site.gpkg; then make \
terrain, and talus-source site.toml --trn out/trn.tif --assume-joints joints.toml makes sections \
that fit" >&2
elif ! measure_slope 2>"$part/.log"; then
  sed '/^make/d' "$part/.log" >&2
  echo "new-site: the slope could not be measured, for the reason above: joint sets are not fitted \
to it" >&2
fi
is_measured=yes
[ -s "$part/.joints" ] || { is_measured=no && hollow >"$part/.joints"; }
grep -q '^\[joints' "$part/.joints" || joints_for_no_slope >>"$part/.joints"
{ head_of_site; cat "$part/.joints"; rest_of_site; } >"$part/site.toml"
[ $is_measured = no ] ||
  (cd "$part" && "${tools}talus-source" site.toml --trn .slope/trn.tif --no-db)
rm -rf "$part/.slope" "$part/.joints" "$part/.log"

cat >"$part/README.md" <<END
# $(basename "$name")

| Data | Origin and licence | Attribution |
|---|---|---|
| \`$(seen_from_site "$ground")\` | | |
$([ -z "$source" ] || echo "| \`$(seen_from_site "$source")\` | | |")

## What is measured

## What is assumed
- joints, friction and restitution in \`site.toml\`, and the failure surface that follows from them
END
chmod 755 "$part"
mv -T "$part" "$name"
trap - EXIT
name=$(realpath "$name")
echo "$name is made: edit $name/site.toml (joints, friction)$([ -z "$layers" ] || echo \
" and the layers of site.gpkg (source, fences)"), then make -C $name"
grep -q '^failure_surface = "daylighting"' "$name/site.toml" ||
  echo "new-site: WARNING: no failure surface of $name/site.toml daylights: most of the mass will \
stay, see [source] there" >&2
