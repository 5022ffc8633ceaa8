# Runs that differ in any one input have different ids; settings without effect on the result do not
# change them.
. "$source_dir/tests/tools/talus-dda/common.sh"
command -v ogr2ogr >/dev/null || skip "needs ogr2ogr"
command -v zip >/dev/null || skip "needs zip"
make_inputs

# ring NAME X: a square whose western side lies at X
ring() {
  cat >"$1" <<EOF
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32632"}}, "features": [
{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
[[[$2, 5000020], [500100, 5000020], [500100, 5000080], [$2, 5000080], [$2, 5000020]]]}}]}
EOF
}
# line NAME X: a fence at X
line() {
  cat >"$1" <<EOF
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "EPSG:32632"}}, "features": [
{"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates":
[[$2, 5000010], [$2, 5000090]]}}]}
EOF
}
# zipped NAME.json: NAME.zip, which holds it
zipped() {
  rm -f "${1%.json}.zip"
  zip -q -X "${1%.json}.zip" "$1"
}
# as_shape NAME.json: NAME.shp with its sidecars
as_shape() {
  rm -f "${1%.json}".shp "${1%.json}".shx "${1%.json}".dbf "${1%.json}".prj
  ogr2ogr -q "${1%.json}.shp" "$1"
}
# classes VALUE: a raster of ground classes, VALUE in its last cell
classes() {
  awk -v last="$1" 'BEGIN {
    print "ncols 30\nnrows 20\nxllcenter 500002.5\nyllcenter 5000002.5\ncellsize 5"
    for (r = 0; r < 20; r++) {
      line = ""
      for (c = 0; c < 30; c++) line = line " " (r == 19 && c == 29 ? last : 1)
      print line
    }
  }' >classes.asc
  gdal_translate -q -ot Int16 -a_srs EPSG:32632 classes.asc classes.tif
}
# shaking A: a motion of the base whose second line holds A
shaking() { printf 'time_s,ax_m_s2,ay_m_s2,az_m_s2\n0,0,0,0\n1,%s,0,0\n9,0,0,0\n' "$1" >shaking.csv; }

ring scree.json 500050
ring soil.json 500060
line upper.json 500070
line lower.json 500080
zipped soil.json
as_shape lower.json
classes 1
shaking 0.1
cat >>site.toml <<'END2'
[ground.scree]
friction_deg = 30
polygon_file = "scree.json"
[ground.soil]
friction_deg = 25
polygon_file = "/vsizip/soil.zip/soil.json"
[ground.wood]
friction_deg = 35
raster_values = [1, 2]
[terrain]
ground_raster = "classes.tif"
[base_motion]
file = "shaking.csv"
[fence.upper]
file = "upper.json"
active = false
[fence.lower]
file = "lower.shp"
active = false
END2

n=0
# id_of OPTIONS...: sets id
id_of() {
  n=$((n + 1))
  expect 0 run_dda -o "run_$n.h5" --set solver.duration_s=0.02 --json "$@"
  id=$(h5dump -a /run_id "run_$n.h5" | sed -n 's/.*(0): "\(.*\)"/\1/p')
  [ ${#id} -eq 16 ] || fail "no id in run_$n.h5"
  rm "run_$n.h5"
}
id_of
first=$id
ids=$first
# same WHAT OPTIONS...: the id is that of the first run
same() {
  what=$1
  shift
  id_of "$@"
  [ "$id" = "$first" ] || fail "another id by $what"
}
# other WHAT OPTIONS...: an id that no run before had
other() {
  what=$1
  shift
  id_of "$@"
  case " $ids " in *" $id "*) fail "the same id in spite of $what" ;; esac
  ids="$ids $id"
}

same "doing it again"
same "--resume" --resume
same "another interval of checkpoints" --set output.checkpoint_interval_s=7
same "another name for an option" --set solver.duration_s=0.02
echo '# a remark' >>site.toml
same "a remark in the site file"

cp slope.tif kept.tif
gdal_edit.py -mo NOTE=other slope.tif
other "another terrain file"
mv kept.tif slope.tif
sed 's/spin_rad_s = .*/spin_rad_s = [0.3, 1, 0.1]/' site.toml >spun.toml
cp blocks.h5 kept.h5
expect 0 talus-blocks spun.toml --trn slope.tif -o blocks.h5 -q --no-db --overwrite
other "other blocks"
mv kept.h5 blocks.h5
ring scree.json 500051
other "another polygon of ground"
ring soil.json 500061
zipped soil.json
other "another polygon of ground in an archive"
classes 2
other "another raster of ground"
shaking 0.2
other "another motion of the base"
line upper.json 500071
other "another fence"
line lower.json 500081
as_shape lower.json
other "another fence in a Shapefile"
other "another value in the site file" --set ground.scree.friction_deg=31
other "another option" --passages-by centroid
other "--settle" --settle
