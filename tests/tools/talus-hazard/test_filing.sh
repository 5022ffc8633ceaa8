# A hazard map to be filed: boxes whose classes are known, by the Swiss model and by INSPIRE, with another recipe.
# Topology, fields and codes are examined through osgeo, not by the tool's own code.
/usr/bin/python3 -c 'from osgeo import ogr' 2>/dev/null || skip 'needs python3-gdal'
run-probe . 12 blocks=3 crs=EPSG:2056
sed -i 's/\[250/[2650/g; s/, 350/, 1200/g' site.toml
cp site.toml plain.toml
filed() { { cat plain.toml; printf '\n[hazard]\nrecipe = "%s"\n' "$1"; shift; for key in "$@"; do printf '%s\n' "$key"; done; printf '[hazard.class.V1]\nfrequency_per_a = 0.0136\n'; } >site.toml; }

# all three keys, or none; values that do not fit the model are refused
filed switzerland_ti 'author = "A. Muster, Muster Ltd"' 'date = "2026-05-31"'
expect 1 talus-hazard site.toml run_*.h5 --trn slope.tif -o maps
says 'hazard: has no namespace'
nothing_left maps/class.tif
for day in 31.5.2026 2026-13-01 2026-05-31T00; do
  filed switzerland_ti 'author = "A"' "date = \"$day\"" 'namespace = "ti.ch"'
  expect 1 talus-hazard site.toml run_*.h5 --trn slope.tif -o maps
  says "date is \"$day\""
done
filed norway_tek17 'author = "A"' 'date = "2026-05-31"' 'namespace = "ti.ch"'
expect 1 talus-hazard site.toml run_*.h5 --trn slope.tif -o maps
says 'has 1 and 3 as the numbers of intensities and classes, the Swiss model 3 and 4'

filed switzerland_ti 'author = "A. Muster, Muster Ltd"' 'date = "2026-05-31"' 'namespace = "ti.ch"'
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o swiss --json swiss.json
prints 'polygons by Hazard_Mapping 1.2; smaller than 100 m2:'
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o again
cmp swiss/filing.gpkg again/filing.gpkg || fail 'the same filing has other bytes'

cat >valley.toml <<'TOML'
name = "Our valley"
edition = "draft"
return_period_a = [50, 500]
matrix = [["watch", "none"], ["act", "watch"]]
min_area_m2 = 20
[intensity]
by = "total_energy_kj"
breaks = [50]
names = ["a wall holds", "a wall breaks"]
[class.act]
code = 2
rgb = [200, 30, 30]
label = "build a fence"
[class.watch]
code = 1
rgb = [250, 190, 60]
label = "look every spring"
[[source]]
of = ["return_period_a", "intensity", "matrix", "class", "min_area_m2"]
document = "Our office"
page = "draft"
mark = "o"
TOML
mkdir rocks
run-probe rocks 12 blocks=3 independent=1 weight=0.01
cp rocks/site.toml plain.toml
filed valley.toml 'author = "B. Modelo"' 'date = "2026-01-02"' 'namespace = "AT.0099.NZ"' &&
  printf '[rockfall.cliff]\nfrequency_per_a = 0.09\n' >>site.toml && sed -i '/^frequency_per_a = 0.0136/d' site.toml
mv site.toml rocks && cp valley.toml rocks
expect 0 talus-hazard rocks/site.toml rocks/run_*.h5 --trn rocks/slope.tif -o inspire --json inspire.json
prints 'polygons by INSPIRE HazardArea'

cat >check.py <<'PY'
import json
import sys
from osgeo import gdal, ogr
ogr.UseExceptions()
CELL = 4  # m2


def layers(path):
    source = ogr.Open(path)
    return {layer.GetName(): [(f.GetGeometryRef().Clone(), f.items()) for f in layer]
            for layer in (source.GetLayer(i) for i in range(source.GetLayerCount()))
            if layer.GetName() != 'layer_styles'}


def sound(features, least, scenario):
    """Valid, large enough, no two of a scenario over each other: all pairs, by areas."""
    for i, (a, of_a) in enumerate(features):
        assert a.GetGeometryType() == ogr.wkbPolygon and a.IsValid(), a.ExportToWkt()
        assert a.GetArea() >= least - 1e-6, a.GetArea()
        for b, of_b in features[:i]:
            if scenario(of_a) == scenario(of_b):
                assert a.Intersection(b).GetArea() < 1e-6


def values_of(path, band=1):
    source = gdal.Open(path)
    return source.GetRasterBand(band).ReadAsArray()


def styled(path, names):
    source = ogr.Open(path)
    styles = {f.GetField('f_table_name'): f for f in source.GetLayerByName('layer_styles')}
    assert set(styles) == set(names), styles.keys()
    for name, style in styles.items():
        assert style.GetField('useAsDefault') == 1 and '<renderer-v2' in style.GetField('styleQML')
        assert source.GetLayerByName(name).GetGeometryColumn() == style.GetField('f_geometry_column')


def balanced(features, raster, band, codes, of, result):
    """What was not joined or left out is what the cells say."""
    filed = {}
    for shape, items in features:
        filed[of(items)] = filed.get(of(items), 0) + shape.GetArea()
    for code, name in codes.items():
        there = CELL * int((values_of(raster, band) == code).sum())
        moved = result['raised_m2'] + result['lowered_m2'] + result['left_out_m2']
        assert abs(filed.get(name, 0) - there) <= moved + 1e-6, (name, filed, there, moved)


swiss = layers('swiss/filing.gpkg')
assert list(swiss) == ['assessment_area', 'hazard_area', 'synoptic_intensity', 'intensity_by_source', 'left_out']
styled('swiss/filing.gpkg', swiss)
result = json.load(open('swiss.json'))['filing']
assert result['n_polygons'] == sum(len(swiss[name]) for name in list(swiss)[1:4]), result
ENUM = {
    'data_responsibility': {'TI'},
    'intensity_class': {'low', 'mean', 'high'},
    'hazard_level': {'residual_hazard', 'slight', 'mean', 'substantial'},
    'main_process': {'rockfall'},
    'subproc_synoptic_intensity': {'r_rock_slide_rock_avalanche'},
    'subproc_intensity_by_source': {'r_rock_slide_rock_avalanche'},
    'sources_in_subprocesses_compl': {'to_be_clarified'},
    'sources_complete': {'to_be_clarified'}, 'subprocesses_complete': {'to_be_clarified'},
    'rf_state_rock_fall': {'not_assessed'}, 'rs_state_rock_slide_rock_aval': {'assessed_and_to_be_clarified'},
    'fl_state_flooding': {'not_assessed'}, 'gs_state_gliding_snow': {'not_assessed'},
    'return_period_in_years': {30, 100, 300}, 'extreme_scenario': {0}, 'subscenario_probability': {1.0}}
MANDATORY = {
    'assessment_area': 'data_responsibility fl_state_flooding df_state_debris_flow be_state_bank_erosion '
    'pl_state_permanent_landslide sl_state_spontaneous_landslide hd_state_hillslope_debris_flow rf_state_rock_fall '
    'rs_state_rock_slide_rock_aval if_state_ice_fall sh_state_sinkhole su_state_subsidence '
    'fa_state_flowing_avalanche pa_state_powder_avalanche gs_state_gliding_snow',
    'hazard_area': 'data_responsibility main_process hazard_level subprocesses_complete sources_complete',
    'synoptic_intensity': 'data_responsibility intensity_class process_cantonal_term extreme_scenario '
    'return_period_in_years subproc_synoptic_intensity sources_in_subprocesses_compl',
    'intensity_by_source': 'data_responsibility intensity_class process_cantonal_term extreme_scenario '
    'return_period_in_years process_source subproc_intensity_by_source subscenario_probability'}
ids = set()
for name, needed in MANDATORY.items():
    assert swiss[name], name
    for _, items in swiss[name]:
        for field in needed.split():
            assert items[field] not in (None, ''), (name, field)
        for field, codes in ENUM.items():
            assert field not in items or items[field] in codes, (name, field, items[field])
        assert items['T_Ili_Tid'].endswith('.ti.ch') and len(items['T_Ili_Tid']) <= 120
        assert items['T_Ili_Tid'] not in ids
        ids.add(items['T_Ili_Tid'])
        assert len(items['comments']) <= 250 and items['comments'].startswith('A. Muster, Muster Ltd, 2026-05-31')
sound(swiss['hazard_area'], 100, lambda i: 0)
sound(swiss['synoptic_intensity'], 100, lambda i: i['return_period_in_years'])
balanced(swiss['hazard_area'], 'swiss/class.tif', 1,
         {1: 'residual_hazard', 2: 'slight', 3: 'mean', 4: 'substantial'}, lambda i: i['hazard_level'], result)
source = ogr.Open('swiss/filing.gpkg')
assert source.GetLayer(0).GetSpatialRef().GetAuthorityCode(None) == '2056'

inspire = layers('inspire/filing.gpkg')
assert list(inspire) == ['perimeter', 'HazardArea_class', 'HazardArea', 'HazardArea_energy', 'left_out'], list(inspire)
styled('inspire/filing.gpkg', inspire)
period = 'likelihoodOfOccurrence_quantitativeLikelihood_returnPeriod'
quality, quantity = 'magnitudeOrIntensity_qualitativeValue', 'magnitudeOrIntensity_quantitativeValue'
for name in ('HazardArea', 'HazardArea_energy', 'HazardArea_class'):
    assert inspire[name], name
    for shape, items in inspire[name]:
        assert items['inspireId_namespace'] == 'AT.0099.NZ' and items['determinationMethod'] == 'modelling'
        assert items['beginLifeSpanVersion'] == '2026-01-02T00:00:00Z' and items['author'] == 'B. Modelo'
        assert items['typeOfHazard_hazardCategory'].endswith('/NaturalHazardCategoryValue/landslide')
        assert items['typeOfHazard_specificHazardType'] == 'rockfall' and items['process_source'] == 'cliff'
        assert abs(items['area_m2'] - shape.GetArea()) < 1e-6
    sound(inspire[name], 20, lambda i: i[period])
assert {i[period] for _, i in inspire['HazardArea']} <= {50, 500} and {i[quality] for _, i in inspire['HazardArea']} <= {
    'a wall holds, up to 50 kJ', 'a wall breaks, above 50 kJ'}
assert {i[quality] for _, i in inspire['HazardArea_class']} <= {'build a fence', 'look every spring'}
result = json.load(open('inspire.json'))['filing']
# energies: no area of a class below that of the map
for shape, items in inspire['HazardArea_energy']:
    assert items[quantity] in (0, 3, 30, 100, 300) and items[quantity + '_uom'] == 'kJ', items
energy = values_of('inspire/ke_T500.tif')
reached = sum(s.GetArea() for s, i in inspire['HazardArea_energy'] if i[period] == 500)
moved = result['raised_m2'] + result['left_out_m2']
assert abs(reached - CELL * int((energy > 0).sum())) <= moved + 1e-6
PY
/usr/bin/python3 check.py || fail 'the filing is not sound'
