# Kinematic shares of the four shared slopes by sloping area, as another program found them on the
# triangles cut with the polygon by GEOS. (The other diagonal of the cells moves them by up to 0.07.)
[ -d "$shared_data" ] || skip "no ../shared/data"
command -v python3 >/dev/null || skip "needs python3"

# look SITE DEM
look() {
  sed "s#\.\./\.\./\.\./shared/data#$shared_data#g" "$source_dir/sample_sites/$1/site.toml" >site.toml
  expect 0 talus-trn "$shared_data/dem/$2" -o trn.tif --overwrite --no-db -q
  expect 0 talus-blocks site.toml --trn trn.tif -o blocks.h5 --trn-out bed.tif --overwrite --no-db -q
  expect 0 talus-check site.toml --trn trn.tif --bed bed.tif --blocks blocks.h5 --report "$1.json" -o "$1.html" \
    --overwrite --no-db --probe-s 0
}
look lechtal_kotcliff lechtal_kotcliff_5m.tif
look lechtal_kotdam lechtal_kotdam_5m.tif
look gschnitz_gar gschnitz_gar_5m.tif
look salisbury_crags salisbury_crags_dsm_2m5.tif
grep -q 'The same at the source' gschnitz_gar.html || fail "a long slope has no section of its source"

python3 - <<'PY' || fail "other shares"
import json
known = {  # slope, sliding, within 20 degrees, wedge: plunge, trend, share, F; flexural toppling on the rear set
    'lechtal_kotcliff': (54, 358, .763, .474, 46, 0, .765, .59, .734),
    'lechtal_kotdam': (48, 342, .809, .435, 36, 353, .801, .82, .541),
    'gschnitz_gar': (53, 144, .928, .736, 44, 149, .915, .63, .923),
    'salisbury_crags': (55, 301, .754, .384, 48, 323, .744, .56, .612)}
wrong = []
def near(site, what, value, wanted, tolerance):
    if abs(value - wanted) > tolerance:
        wrong.append(f'{site} {what}: {value:.3f}, expected {wanted} +- {tolerance}')
for site, (dip, aspect, slides, lateral, plunge, trend, wedge, factor, topples) in known.items():
    look = json.load(open(site + '.json'))
    sets = {s['set']: s for s in look['kinematics']['sets']}
    pair = next(p for p in look['kinematics']['pairs'] if p['sets'] == 'sliding + lateral')
    near(site, 'dip', look['source']['slope_dip_deg'], dip, 1.5)
    near(site, "aspect", look["source"]["slope_dip_direction_deg"], aspect, 3)
    near(site, 'slides', sets['sliding']['slides']['mean'], slides, .001)
    near(site, 'within 20', sets['sliding']['slides_within_20_deg']['mean'], lateral, .001)
    near(site, 'plunge', pair['plunge_deg'], plunge, .6)
    near(site, 'trend', (pair['trend_deg'] - trend + 180) % 360 - 180, 0, .6)
    near(site, 'wedge', pair['slides']['mean'], wedge, .001)
    near(site, 'F', pair['factor_of_safety'], factor, .006)
    near(site, 'topples', sets['rear']['topples']['mean'], topples, .001)
print('\n'.join(wrong))
assert not wrong
PY
