# A site with a forest in an area of a file: hit trees come to the layers and to the report.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v python3 >/dev/null || skip "needs python3"
site wood
sed -i 's/^duration_s = .*/duration_s = 3/' wood/site.toml
cat >>wood/site.toml <<'END'
[forest.below]
polygon_file = "below.geojson"
stems_per_ha = 800
END
cat >wood/below.geojson <<'END'
{"type": "FeatureCollection", "crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32633"}},
 "features": [{"type": "Feature", "properties": {}, "geometry": {"type": "Polygon", "coordinates":
  [[[500090, 5200200], [500150, 5200200], [500150, 5200246], [500090, 5200246], [500090, 5200200]]]}}]}
END
made wood -j2
expect 0 make -q -C wood BIN=
on_page wood/out/runout.gpkg
grep -q '^forest.below.stems_per_ha = 800' wood/out/stages/run.txt || fail 'the stage run does not read it'
python3 - wood/out <<'END' || fail 'see above'
import json, re, sqlite3, sys, zipfile
out = sys.argv[1]
trees = json.load(open(f'{out}/runout.json'))['trees']
forest, = trees['forests']
assert forest['forest'] == 'below' and forest['broken'] >= 3, forest
page = open(f'{out}/report.html', encoding='utf-8').read()
assert 'id="trees"' in page and 'href="#trees"' in page, 'no section on trees'
assert f"The {min(20, trees['n_stems_hit'])} stems that were hit most, of {trees['n_stems_hit']}" in page
layers = sqlite3.connect(f'{out}/runout.gpkg')
n, = layers.execute('select count(*) from trees_hit').fetchone()
assert n == trees['n_stems_hit']
archive = zipfile.ZipFile(f'{out}/site.qgz')
project = archive.read(archive.namelist()[0]).decode()
assert 'layername=trees_hit' in project and 'layername=tree_hits' in project
END
