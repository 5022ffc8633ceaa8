# The id of a run counts all that a data set is made of: a journal of SQLite, the source of a virtual
# raster, a CRS or world file beside a raster. The same id means the same bytes.
command -v python3 >/dev/null && command -v ogr2ogr >/dev/null || skip "needs python3 and GDAL's programs"
python3 - <<'END' || fail "changes in the journal of a GeoPackage make no other run"
import json, sqlite3, subprocess
lines = [{"type": "Feature", "properties": {"z": 10 * k}, "geometry": {"type": "LineString",
          "coordinates": [[500000, 5200000 + 10 * k], [500050, 5200000 + 10 * k]]}} for k in range(6)]
json.dump({"type": "FeatureCollection", "features": lines}, open("c.geojson", "w"))
subprocess.run(["ogr2ogr", "-a_srs", "EPSG:32633", "-lco", "SPATIAL_INDEX=NO", "c.gpkg", "c.geojson"], check=True)
def tin():
    run = subprocess.run(["talus-tin", "c.gpkg", "-o", "c.ply", "--overwrite", "--json", "--no-db",
                          "--elevation-field", "z"], capture_output=True, check=True)
    return json.loads(run.stdout)["run_id"], open("c.ply", "rb").read()
shown = sqlite3.connect("c.gpkg", isolation_level=None)  # as QGIS keeps a layer that it shows
shown.execute("PRAGMA journal_mode = WAL").fetchall()
shown.execute("SELECT * FROM c").fetchone()
one = tin()
again = tin()
shown.execute("UPDATE c SET z = 3 * z")
two = tin()
assert one == again and one[1] != two[1] and one[0] != two[0], (one[0], again[0], two[0])
END

id_of() {
  expect 0 talus-trn "$1" -o t.tif --overwrite --no-db --json
  python3 -c 'import json; print(json.load(open("out"))["run_id"])'
}
awk 'BEGIN { print "ncols 9\nnrows 9\nxllcorner 500000\nyllcorner 5200000\ncellsize 5"
  for (r = 0; r < 9; r++) { for (c = 0; c < 9; c++) printf "%g ", 100 + 2 * c; print "" } }' >dem.asc
gdal_translate -q -ot Float64 -a_srs EPSG:32633 dem.asc part.tif
gdalbuildvrt -q all.vrt part.tif
one=$(id_of all.vrt)
[ "$(id_of all.vrt)" = "$one" ] || fail "the same files make another run"
sed 's/116/119/' dem.asc >higher.asc
gdal_translate -q -ot Float64 -a_srs EPSG:32633 higher.asc part.tif
[ "$(id_of all.vrt)" != "$one" ] || fail "another source of a virtual raster makes no other run"
# a virtual raster of a virtual raster: the source at the end counts
gdalbuildvrt -q whole.vrt all.vrt
one=$(id_of whole.vrt)
gdal_translate -q -ot Float64 -a_srs EPSG:32633 dem.asc part.tif
[ "$(id_of whole.vrt)" != "$one" ] || fail "another source of a virtual raster in another one makes no other run"
gdalsrsinfo --single-line -o wkt_esri EPSG:32633 | sed '/^$/d' >dem.prj
one=$(id_of dem.asc)
gdalsrsinfo --single-line -o wkt_esri EPSG:32632 | sed '/^$/d' >dem.prj
[ "$(id_of dem.asc)" != "$one" ] || fail "another CRS beside a raster makes no other run"
