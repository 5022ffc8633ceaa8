# Dams of a site are burnt into the terrain: volumes against the sum over its nodes, other nodes bit
# for bit, lines from a file in another system, refusals, doubts.
. "$source_dir/tests/tools/talus-trn/plane.sh"
plane plane.asc
gdal_translate -q -ot Float64 -a_srs EPSG:25832 plane.asc dem.tif
expect 0 talus-trn dem.tif -o ground.tif --cell-size-m 1
cat >site.toml <<'TOML'
[site]
crs = "EPSG:25832"
[dam.road]
line = [[650070, 5200110], [650130, 5200110]]
slopes_deg = [60, 40]
ditch_m = [1.5, 3]
TOML
expect 0 talus-trn dem.tif site.toml -o dam.tif --cell-size-m 1 --report dam.json
prints 'dam road: 60 m long, crest 5 to 5 m above the ground, fill '

# net FILE: sum of the rise of its nodes [m3], and how many moved
net() {
  gdal_translate -q -of XYZ "$1" moved.xyz && gdal_translate -q -of XYZ ground.tif was.xyz
  paste was.xyz moved.xyz | awk '$3 != $6 { s += $6 - $3; n++ } END { printf "%.9f %d\n", s, n }'
}
set -- $(net dam.tif)
python3 - "$1" "$2" <<'PY' || fail "the volumes are not what the nodes moved: $1 m3 in $2 nodes"
import json, math, sys
dam, = json.load(open("dam.json"))["dams"]
cells, designed = dam["in_cells"], dam["designed"]
assert abs(cells["fill_m3"] - cells["cut_m3"] - float(sys.argv[1])) < 0.02  # of 9 digits
assert dam["n_nodes"] == int(sys.argv[2])
assert [round(z, 6) for z in (p[2] for p in dam["crest"])] == [1060, 1060]
# section: slope 1 : 2, faces of 60 and 40 degrees, crest of 2 m
u, d, a, h, w = math.tan(math.radians(60)), math.tan(math.radians(40)), 0.5, 5, 2
up, down = (h + w / 2 * u) / (u + a), (h + w / 2 * d) / (d - a)
section = h * w + (h - a * w / 2) * (up - w / 2) / 2 + (h + a * w / 2) * (down - w / 2) / 2
ends = designed["fill_m3"] - 60 * section  # both heads of it
assert 0 < ends < 25 * section, (designed, section)
assert abs(cells["fill_m3"] / designed["fill_m3"] - 1) < 0.05, dam
PY

# the same dam from a file in another system, and through talus-import
printf 'id,wkt\n1,"LINESTRING (650070 5200110, 650130 5200110)"\n' >line.csv
ogr2ogr -q -f GPKG -s_srs EPSG:25832 -t_srs EPSG:4258 -oo GEOM_POSSIBLE_NAMES=wkt line.gpkg line.csv
sed 's/^line = .*/file = "line.gpkg"/' site.toml >file.toml
expect 0 talus-import file.toml --set terrain.dem=dem.tif -o inputs.gpkg
expect 0 talus-trn dem.tif file.toml --inputs inputs.gpkg -o file.tif --cell-size-m 1 --json
python3 - dam.json out <<'PY' || fail "a line in another system makes another dam"
import json, sys
one, other = (json.load(open(f))["dams"][0] for f in sys.argv[1:])
assert abs(one["designed"]["fill_m3"] / other["designed"]["fill_m3"] - 1) < 1e-3
PY

# one that is not built changes nothing
expect 0 talus-trn dem.tif site.toml --set dam.road.active=false -o none.tif --cell-size-m 1
[ "$(net none.tif)" = "0.000000000 0" ] || fail "a dam that is not built moved nodes"

# none is built on a terrain that has it already; what is not built changes nothing there
expect 1 talus-trn dam.tif site.toml -o no.tif
says 'has dams in its ground, on which those of the site would be built'
expect 0 talus-trn dam.tif site.toml --set dam.road.active=false -o same.tif

# cells too wide for the crest: how much of it they lose
expect 0 talus-trn dem.tif site.toml -o wide.tif --doubts wide.gpkg
says 'dam.road.crest_width_m, x 650130, y 5200110: 2 m on cells of 5 m: the terrain lies up to 2.52 m below the crest'
says 'dam.road.ditch_m, x 650070, y 5200110: 3 m on cells of 5 m: the terrain has '
says 'in the cells it is at most 45 degrees steep'

# down the slope neither side is higher
sed '/^ditch_m/d; s/^line.*/line = [[650100, 5200090], [650100, 5200130]]/' site.toml >down.toml
expect 0 talus-trn dem.tif down.toml -o down.tif --cell-size-m 1
says 'uphill is taken to be left of the line seen from its first point, where the ground lies 0 m higher than on the other side, 16 m from the line'

# dams that cannot be built
expect 1 talus-trn dem.tif site.toml -o no.tif --set 'dam.road.slopes_deg=[60, 28]'
says 'the downhill face of 28 degrees does not meet the ground within ten heights'
expect 1 talus-trn dem.tif site.toml -o no.tif --set 'dam.road.line=[[650070, 5200010], [650130, 5200004]]'
says 'reaches beyond the known ground'
expect 1 talus-trn dem.tif site.toml -o no.tif --set 'dam.road.line=[[650070, 5200110], [650130, 5200110], [650130, 5200120], [650100, 5200100]]'
says 'crosses itself'
printf '[dam.other]\nline = [[650100, 5200112], [650150, 5200112]]\n' >>site.toml
expect 1 talus-trn dem.tif site.toml -o no.tif --cell-size-m 1
says 'shares ground with dam.road'

# a gallery: a roof with vertical sides, which neither slopes nor a ditch can be of
sed -i '/^\[dam.other\]/,$d; /^ditch_m/d; s/^slopes_deg.*/kind = "gallery"\nheight_m = 6\ncrest_width_m = 8/' site.toml
expect 0 talus-trn dem.tif site.toml -o roof.tif --cell-size-m 1 --report roof.json
prints 'gallery road: 60 m long, 8 m wide, roof 6 to 6 m above the ground'
set -- $(net roof.tif)
python3 - "$1" "$2" <<'PY' || fail "the roof is not what the nodes moved: $1 m3 in $2 nodes"
import json, sys
roof, = json.load(open("roof.json"))["dams"]
assert roof["kind"] == "gallery" and "designed" not in roof
assert roof["n_nodes"] == int(sys.argv[2]) == 61 * 9  # both borders of 60 m by 8 m
assert abs(float(sys.argv[1]) - 61 * 9 * 6) < 1e-4  # the mean of 6 m -+ 2 m on a slope of 1 : 2
PY
for key in 'slopes_deg=[70, 40]' 'ditch_m=[1, 2]' capacity_kj=100; do
  expect 1 talus-trn dem.tif site.toml -o no.tif --set "dam.road.$key"
  says "dam.road: is a gallery with ${key%%=*}"
done
