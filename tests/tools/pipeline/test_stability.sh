# make stability: the factor of safety against water, in the look before the runs, the report and the
# project; stale once the water, the strength or the blocks differ.
. "$source_dir/tests/tools/pipeline/common.sh"
command -v talus-stability >/dev/null || skip "needs the tools of this checkout"
site slope
sed -i 's/^friction_deg = 25/friction_deg = 45/' slope/site.toml
made slope -j2
if grep -q 'id="stability"' slope/out/report.html; then fail "a factor that nobody asked for"; fi
made slope -n stability
[ "$(grep -c '^talus-' out)" = 1 ] || fail "make stability would start more than its tool: $(cat out)"
made slope stability report
on_page slope/out/stability/blocks.gpkg
[ ! -e slope/out/stability/levels.svg ] || fail "levels without [water]"
for page in check report; do
  grep -q 'The slope is held by a factor of 1.' slope/out/$page.html || fail "$page says no factor"
done
grep -q '"stability"' slope/out/check.json || fail "no factor in check.json"
unzip -p slope/out/site.qgz | grep -q 'blocks.gpkg|layername=stability' || fail "no layer of the blocks that go first"
made slope stability report
prints 'Nothing to be done'

# would GOAL...: the tools that make would start now
would() {
  made slope -n "$@"
  sed -n 's/^talus-\([a-z]*\) .*/\1/p' out | sort | tr '\n' ' '
}
cp slope/site.toml dry.toml
printf '[water]\ndepth_m = 5\n' >>slope/site.toml
case $(would stability) in 'stability ') ;; *) fail "with water: $(cat out)" ;; esac
case $(would) in *check*report*stability*) ;; *) fail "an old factor in the report: $(cat out)" ;; esac
made slope stability
[ -s slope/out/stability/levels.svg ] || fail "no chart of the levels"
python3 - slope/out/stability/stability.json <<'END' || fail "the factor does not fall with the water"
import json, sys
j = json.load(open(sys.argv[1]))
factors = [row["mass"]["factor"] for row in j["levels"]]
assert factors == sorted(factors, reverse=True) and factors[0] > factors[-1] + 0.1, factors
END
made slope
for words in 'it fails when water in the joints rises to' 'How often it fails is an input' 'Factor of safety against'; do
  grep -q "$words" slope/out/report.html || fail "the report does not say: $words"
done
for language in de fr it; do
  expect 0 talus-report slope/site.toml --dir slope/out -o slope/out/$language.html --texts $language --no-db
  if sed -n '/id="stability"/,/<\/section>/p' slope/out/$language.html | sed 's/<code>[^<]*<\/code>//g; s/src="[^"]*"//' |
    grep -wE 'the|slope|fails|factor of|blocks'; then fail "$language: English words"; fi
  rm slope/out/$language.html
done

# by hand: a factor of other water is left out of the report
sed -i 's/^depth_m = 5/depth_m = 4/' slope/site.toml
expect 1 talus-report slope/site.toml --dir slope/out -o page.html --no-db
sed -i 's/^depth_m = 4/depth_m = 5/' slope/site.toml
sed -i 's/"sections": "[0-9a-f]*"/"sections": "0"/' slope/out/stability/stability.json
expect 0 talus-report slope/site.toml --dir slope/out -o page.html --no-db
says "left out: stability/stability.json, stability/blocks.gpkg"
made slope clean
[ ! -e slope/out ] || fail "left: $(find slope/out)"
