# Observations drawn in site.gpkg, or in files: make puts them beside the runs, on the page of the report
# and into the project, and another observation repeats that alone.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v ogr2ogr >/dev/null || skip "needs gdal-bin"
command -v python3 >/dev/null || skip "needs python3"
edit() { ogrinfo -q drawn/site.gpkg -sql "$1" >edited 2>&1 || { cat edited >&2; fail "cannot edit: $1"; }; }
insert() { edit "INSERT INTO $1 (geom, $2) VALUES (AsGPB(GeomFromText('$3', 32633)), $4)"; }
site drawn
sed -i 's/^duration_s = .*/duration_s = 4/' drawn/site.toml # blocks move more than a metre
expect 0 talus-site --new-layers drawn/site.gpkg --crs-of drawn/contours.gpkg --no-db
insert observed_boulders 'name, volume_m3, date' 'POINT(500120 5200240)' "'spring', 2.5, '2019'"
insert observed_boulders name 'POINT(500124 5200230)' "'spring'"
insert observed_scars 'name, height_m' 'POINT(500120 5200244)' "'spring', 1.2"
insert observed_outlines name 'MULTIPOLYGON(((500096 5200220, 500144 5200220, 500144 5200250, 500096 5200220)))' "'spring'"
insert objects name 'MULTIPOLYGON(((500096 5200200, 500144 5200200, 500144 5200210, 500096 5200200)))' "'hut'"
sed -i 's/^crs = .*/&\nlayers = "site.gpkg"/' drawn/site.toml
made drawn -j2
python3 - <<'PY' || fail "see above"
import json, re, zipfile
event, = json.load(open('drawn/out/calibrate.json'))['events']
assert event['event'] == 'spring' and event['boulders']['n'] == 2 and event['scars']['n'] == 1, event
assert event['boulders']['points'][0]['volume_m3'] == 2.5
page = open('drawn/out/report.html', encoding='utf-8').read()
section = page[page.index('<section id="observed">'):]
section = section[:section.index('</section>')]
assert 'spring' in section and 'needs 6' in section and '<svg' in section and 'lies within the observed outline' in section
assert not re.search(r'\{\{|\}\}', section)
project = zipfile.ZipFile('drawn/out/site.qgz').read(zipfile.ZipFile('drawn/out/site.qgz').namelist()[0]).decode()
for name in ('calibrate.gpkg|layername=observed_boulders', 'site.gpkg|layername=observed_scars'):
    assert name in project, name
# the name of the object once, by the result; the source that is computed over the one that is drawn
layers = {found[1]: found[0] for found in re.findall(r'(?s)(<maplayer .*?<datasource>\./([^<]*)<.*?</maplayer>)', project)}
assert '<labeling' in layers['trace.gpkg|layername=objects'], layers.keys()
assert not any('<labeling' in text for name, text in layers.items() if 'site.gpkg|layername=object' in name)
assert any('<labeling' in text for name, text in layers.items() if 'site.gpkg|layername=observed_scars' in name)
order = project[project.index('<layer-tree-group'):]
assert order.index('blocks.gpkg|layername=source_area') < order.index('site.gpkg|layername=source')
PY
on_page drawn/out/calibrate.gpkg

# another height of a scar: nothing is computed again
edit "UPDATE observed_scars SET height_m = 3"
made drawn -n
prints talus-calibrate
if grep -q '^talus-\(blocks\|batch\|runout\)' out; then fail "an observation repeats the runs"; fi
# a slip of the pen stops make before the runs
edit "UPDATE observed_scars SET height_m = -3"
expect 2 make -C drawn BIN= calibrate
says 'height_m is -3, expected 0 to 100'
edit "ALTER TABLE observed_scars ADD COLUMN heigth_m REAL"
edit "UPDATE observed_scars SET heigth_m = 3"
expect 2 make -C drawn BIN= calibrate
says 'did you mean height_m?'
