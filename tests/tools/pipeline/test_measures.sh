# A measure is computed with the seeds of the site, takes over shared parts, and is compared.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v python3 >/dev/null || skip "needs python3"
site slope
sed -i 's/^duration_s = .*/duration_s = 3/' slope/site.toml
cat >>slope/site.toml <<'TOML'
[object.foot]
polygon = [[500090, 5200230], [500150, 5200230], [500150, 5200246], [500090, 5200246]]
[hazard.class.all]
frequency_per_a = 0.01
TOML
cat >measures <<'TOML'
[variant.near]
cost = 123456
fence.valley.line = [[500060, 5200240], [500164, 5200240]]
[variant.seldom]
hazard.class.all.frequency_per_a = 0.001
[variant.strong]
fence.valley.height_m = 9
fence.valley.capacity_kj = 5000
[variant.bare]
without = ["fence.valley"]
terrain.flat = "keep"
TOML

# refused before anything is made
variants slope '[variant.near]\nfence.vally.height_m = 3'
expect 2 make -C slope BIN=
says "changes fence.vally, which the site does not have"
says "did you mean valley?"
variants slope '[variant.near]\nground.slope.polygon_file = "absent.gpkg"'
expect 2 make -C slope BIN=
says "there is no file"
nothing_left slope/out/trn.tif
variants slope '[variant.near]\nfence.valley.line = [[500060, 5200150], [500964, 5200150]]'
expect 2 make -C slope BIN=
says "leaves the known terrain"
nothing_left slope/out/runs/run_1.h5
variants slope ''
cat measures >>slope/site.toml

made slope -n RUNS=2
made slope -j2 RUNS=2
tools_of() { talus-runs --db "slope/out/$1/runs.sqlite" list | grep -o 'talus-[a-z]*' | sort -u | tr '\n' ' '; }
for tool in import tin trn blocks; do
  case $(tools_of variant/near) in *talus-$tool*) [ $tool = import ] || fail "talus-$tool was started for another fence" ;; esac
done
cmp slope/out/bed.tif slope/out/variant/near/bed.tif && cmp slope/out/blocks.h5 slope/out/variant/near/blocks.h5 ||
  fail "a fence changed the terrain or the blocks"
case $(tools_of variant/seldom) in *talus-dda*) fail "runs were made anew for another frequency" ;; esac
case $(tools_of variant/bare) in *talus-tin*) ;; *) fail "the terrain was not made again" ;; esac
[ ! -e slope/out/variant/bare/fence.json ] || fail "a fence stands that is taken out"
python3 - <<'PY' || fail "the comparison is another one"
import json
def foot(folder): return json.load(open(f'slope/out/{folder}trace.json'))['objects'][0]
site, near, bare, seldom = (foot(f) for f in ('', 'variant/near/', 'variant/bare/', 'variant/seldom/'))
assert seldom['hits_a_run'] == site['hits_a_run'] and seldom['compared']['hits_a_run']['difference'] == 0
assert abs(seldom['frequency_per_a'][0] - site['frequency_per_a'][0] / 10) < 1e-9
seldom_less = seldom['compared']['frequency_per_a']['difference']
assert abs(seldom_less + 0.9 * site['frequency_per_a'][0]) < 1e-9, seldom_less
assert site['hits_a_run'] > 0
for of in near, bare:
    hits = of['compared']['hits_a_run']
    assert (hits['site'], hits['variant']) == (site['hits_a_run'], of['hits_a_run']), hits
    assert hits['difference'] == of['hits_a_run'] - site['hits_a_run']
page = open('slope/out/report.html').read()
for words in 'Measures compared', '123,000', 'variant/near/report.html', 'the site as it is':
    assert words in page, words
PY
# runs without fences: those of the site where fences differ in height and strength alone
[ -e slope/out/variant/near/without/run_2.h5 ] || fail "no runs without a fence that stands elsewhere"
[ ! -e slope/out/variant/strong/without ] || fail "the runs without fences were made again for a stronger one"
made slope -j2 RUNS=2 VARIANT=strong OUT=own fence
[ -e slope/own/without/run_2.h5 ] || fail "no runs without fences of a measure by itself"
grep -v -i "run_id\|run_set" slope/own/fence.json >own.json
grep -v -i "run_id\|run_set" slope/out/variant/strong/fence.json >shared.json
cmp own.json shared.json || fail "the runs of the site without fences give other results"
rm -r slope/own
gdalinfo slope/out/variant/bare/maps/compare.tif >info
grep -q reach_probability_difference info && grep -q 'MEASURE=bare$' info || fail "no map of differences"
grep -q 'DIFFERENCE=bare minus the site as it is' info || fail "the map of differences names no measure"

# again: nothing; another key of one measure: that one alone
n_runs() { talus-runs --db "slope/out/$1/runs.sqlite" list | grep -c 'talus-dda ' || true; }
made slope -j2 RUNS=2 V=1
if grep -q '^ *talus-[a-z]* ' out; then fail "made again: $(grep '^ *talus-' out)"; fi
before="$(n_runs .) $(n_runs variant/bare)"
near=$(n_runs variant/near)
sed -i 's/^fence.valley.line = .*/&\nfence.valley.height_m = 3/' slope/site.toml
made slope -j2 RUNS=2
[ "$(n_runs .) $(n_runs variant/bare)" = "$before" ] || fail "runs of others were made again"
[ "$(n_runs variant/near)" -gt "$near" ] || fail "the runs of the measure were not made again"

made slope clean
nothing_left slope/out
