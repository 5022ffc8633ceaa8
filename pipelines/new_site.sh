#!/bin/sh
# new_site.sh NAME GROUND [SOURCE [PIPELINES [TOOLS [ROCKFALL]]]]: a folder NAME with site.toml,
# site.gpkg, Makefile and README.md for a slope: GROUND is an elevation model or a contour map,
# SOURCE a vector file with the release polygon, both in a projected CRS. ROCKFALL=yes: rocks that
# fall one by one; GROUND may then be a folder of rasters as of Rockyfor3D. The ground is not
# copied; site.toml names it where it is. The source becomes a layer of site.gpkg; without one it is
# drawn there. The tools (folder TOOLS/, or on the search path) measure the slope, and joint sets
# are assumed to fit.
set -eu
name=${1:-} ground=${2:-} source=${3:-} pipelines=${4:-$(dirname "$0")} tools=${5:-}
rockfall=${6:-}
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
case $rockfall in ''|yes) ;; *) say "ROCKFALL is $rockfall, expected yes" 2 ;; esac
cells= # the folder of Rockyfor3D, seen from the site
if [ -d "$ground" ]; then
  cells=$ground ground=$ground/dem.asc
  [ -n "$rockfall" ] || say "$cells is a folder: a folder of Rockyfor3D needs ROCKFALL=yes; else \
give its raster" 1
  [ -f "$cells/rockdensity.asc" ] || say "$cells has no rockdensity.asc: expected rasters as of \
Rockyfor3D (dem.asc, rockdensity.asc, d1.asc, ...)" 1
fi
for file in "$ground" ${source:+"$source"}; do [ -f "$file" ] || say "$file: there is no such \
file, seen from $PWD: give its whole path" 1; done

# A raster or a vector file? A file that GDAL opens as a raster is taken as an elevation model.
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
END
  [ -z "$cells" ] || [ ! -f "$cells/soiltype.asc" ] ||
    echo "ground_raster = \"$(seen_from_site "$cells/soiltype.asc")\""
  [ -z "$rockfall" ] || return 0
  printf '\n[source]\n'
  [ -n "$layers" ] || echo "polygon_file = \"$(seen_from_site "$source")\""
}
# Rocks one by one: where they start is drawn, in SOURCE, or in cells.
rocks_of_site() {
  density=2600
  [ -z "$cells" ] || density=$(values_of rockdensity.asc | awk '$1 > 0' | tail -n 1)
  cat <<END

# Rocks that fall one by one; another run draws others. make RUNS=50 draws more.
[rockfall.cliff]
END
  if [ -n "$cells" ]; then
    for raster in rockdensity d1 d2 d3 blshape; do
      [ ! -f "$cells/$raster.asc" ] ||
        echo "${raster}_raster = \"$(seen_from_site "$cells/$raster.asc")\""
    done
    [ -f "$cells/d1.asc" ] || echo 'volume_m3 = 0.5'
    [ -f "$cells/blshape.asc" ] || echo 'shape = "rock"'
  else
    [ -z "$source" ] || echo "polygon_file = \"$(seen_from_site "$source")\""
    [ -n "$source" ] ||
      echo "# its areas are drawn in the layer release_areas of site.gpkg, named cliff; without \
them all steep ground releases rocks"
    cat <<END
min_slope_deg = 40            # flatter ground releases none
shape = "rock"                # the hull of points on an ellipsoid; or eota111, eota211, eota221
size_m = [1.2, 1.0, 0.8]      # proportions
volume_m3 = 0.2               # from this volume
volume_max_m3 = 2             # to this one
volume_exponent = 1           # the number of rocks above V goes with V^-1
END
  fi
  cat <<END
rocks = 1                     # of each place, in a run
height_above_ground_m = 0.5
# frequency_per_a = 0.5       # rocks a year of the whole source, above volume_m3

[material.rock]
density_kg_m3 = $density

[solver]
duration_s = 120

END
  ground_of_site
  [ -z "$layers" ] || echo "# Fences, forest and objects are drawn in the layers of site.gpkg."
}
ground_of_site() {
  if [ -z "$cells" ] || [ ! -f "$cells/soiltype.asc" ]; then
    printf '[ground.slope]\nsoil = "talus"\n'
  else
    # the classes of Rockyfor3D, by the nearest soil that Talus knows
    for class in 0:swamp 1:soft_soil 2:meadow 3:scree 4:talus 5:thin_soil 6:rock 7:asphalt; do
      values_of soiltype.asc | grep -qx "${class%:*}" || continue
      printf '[ground.%s]\nsoil = "%s"\nraster_values = [%s]\n' "${class#*:}" "${class#*:}" \
        "${class%:*}"
    done
  fi
  [ -n "$cells" ] || return 0
  if [ -f "$cells/nrtrees.asc" ]; then
    printf '\n[forest.wood]\n'
    for raster in nrtrees dbhmean dbhstd conif_percent; do
      [ ! -f "$cells/$raster.asc" ] ||
        echo "${raster}_raster = \"$(seen_from_site "$cells/$raster.asc")\""
    done
  fi
}
# The values of a raster, ascending, whole numbers without a fraction.
values_of() {
  gdal_translate -q -of XYZ "$cells/$1" /vsistdout/ | awk '{ print $3 + 0 }' | sort -gu
}
# Files of the folder that are not taken over, a row each.
not_taken() {
  for raster in rg70 rg20 rg10; do
    [ ! -f "$cells/$raster.asc" ] || echo "$raster.asc: Talus has no roughness of the ground by \
heights of obstacles; the soils have rolling resistance instead"
  done
  [ ! -f "$cells/soiltype.asc" ] || echo "soiltype.asc: each class is the nearest soil of Talus, \
whose numbers are its own"
  for file in "$cells"/*; do
    case $(basename "$file") in
      dem.asc|rockdensity.asc|d[123].asc|blshape.asc|rg70.asc|rg20.asc|rg10.asc|soiltype.asc) ;;
      nrtrees.asc|dbhmean.asc|dbhstd.asc|conif_percent.asc|*.prj|*.aux.xml) ;;
      treefile.*|*.txt) echo "$(basename "$file"): a list of stems is [forest.NAME] stems_file, \
with x, y and dbh_cm" ;;
      *) echo "$(basename "$file"): unknown, not taken" ;;
    esac
  done
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
layers= layer_source=$source
[ -z "$rockfall" ] || layer_source=
if ! "${tools}talus-source" --help >/dev/null 2>&1; then
  [ -n "$source$cells" ] || say "the tools are not built (sh pipelines/demo.sh), so no layer can \
be made to draw the source in: give SOURCE" 1
  echo "new-site: the tools are not built (sh pipelines/demo.sh)$([ -n "$rockfall" ] || echo ": \
joint sets are not fitted to the slope")" >&2
elif "${tools}talus-site" --new-layers "$part/site.gpkg" --crs-of "$ground" \
  ${layer_source:+--source "$layer_source"} --no-db >/dev/null 2>"$part/.log"; then
  layers=yes
else
  cat "$part/.log" >&2
  [ -n "$source$cells" ] || exit 1
  echo "new-site: no site.gpkg can be made, for the reason above: site.toml names the release \
polygon where it is" >&2
fi
if [ -n "$rockfall" ]; then
  { head_of_site; rocks_of_site; } >"$part/site.toml"
else
  { head_of_site; rest_of_site; } >"$part/site.toml"
  if ! "${tools}talus-source" --help >/dev/null 2>&1; then
    :
  elif [ -z "$source" ]; then
    echo "new-site: there is no source yet: draw it in the layer source of site.gpkg; then make \
terrain, and talus-source site.toml --trn out/trn.tif --assume-joints joints.toml makes sections \
that fit" >&2
  elif ! measure_slope 2>"$part/.log"; then
    sed '/^make/d' "$part/.log" >&2
    echo "new-site: the slope could not be measured, for the reason above: joint sets are not \
fitted to it" >&2
  fi
  is_measured=yes
  [ -s "$part/.joints" ] || { is_measured=no && hollow >"$part/.joints"; }
  grep -q '^\[joints' "$part/.joints" || joints_for_no_slope >>"$part/.joints"
  { head_of_site; cat "$part/.joints"; rest_of_site; } >"$part/site.toml"
  [ $is_measured = no ] ||
    (cd "$part" && "${tools}talus-source" site.toml --trn .slope/trn.tif --no-db)
  rm -rf "$part/.slope" "$part/.joints"
fi
rm -f "$part/.log"

cat >"$part/README.md" <<END
# $(basename "$name")

| Data | Origin and licence | Attribution |
|---|---|---|
| \`$(seen_from_site "$ground")\` | | |
$([ -z "$source" ] || echo "| \`$(seen_from_site "$source")\` | | |")
$([ -z "$cells" ] || echo "| \`$(seen_from_site "$cells")\` | | |")

## What is measured

## What is assumed
- $([ -n "$rockfall" ] && echo "sizes and shapes of the rocks, and the soils, in \`site.toml\`" ||
  echo "joints, friction and restitution in \`site.toml\`, and the failure surface that follows \
from them")
END
chmod 755 "$part"
mv -T "$part" "$name"
trap - EXIT
name=$(realpath "$name")
echo "$name is made: edit $name/site.toml ($([ -n "$rockfall" ] && echo "rocks, soils" || echo \
"joints, friction"))$([ -z "$layers" ] || echo " and the layers of site.gpkg (source, fences)"), \
then make -C $name"
[ -z "$cells" ] || not_taken | sed 's/^/new-site: not taken over: /' >&2
[ -n "$rockfall" ] || grep -q '^failure_surface = "daylighting"' "$name/site.toml" ||
  echo "new-site: WARNING: no failure surface of $name/site.toml daylights: most of the mass will \
stay, see [source] there" >&2
