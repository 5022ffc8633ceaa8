# --texts: an office's words replace those shipped; texts that do not fit are refused with its
# line, missing ones are counted.
run-probe . 2 still_runs=1
mkdir -p results/runs
mv run_*.h5 results/runs/
cp slope.tif results/trn.tif
expect 0 talus-runout results/runs/*.h5 --trn results/trn.tif -o results/runout.gpkg --json results/runout.json --no-db
# report NAME CODE OPTION...: NAME.html, without its run id
report() {
  name=$1 code=$2
  shift 2
  expect "$code" talus-report site.toml --dir results -o "$name.html" --no-db --overwrite "$@"
  [ "$code" != 0 ] || sed -i 's/run id <code>[0-9a-f]*/run id <code>/' "$name.html"
}
shipped=$source_dir/tools/report/texts.toml
report plain 0
grep -q '{[a-z_0-9]*}</\|{{' plain.html && fail 'a name without its value'
report copy 0 --texts "$shipped"
[ ! -s err ] || fail "a whole file is warned of: $(cat err)"
cmp plain.html copy.html || fail 'a copy of the words gives another page'

cat >office.toml <<'END'
page.language = "de"
page.sections = ["maps", "result", "health", "runout", "provenance"]
nav.maps = "Karten"
[result]
moved = """
der Masse bewegte sich
  mehr als 1 m, {far} mehr als 20 m"""
[runout]
one_run_heads = ["Gr&ouml;&szlig;e", "Zahl"]
[said]
"impacts" = "Stöße"
"blocks that left the terrain" = "verließen das Gelände"
[maps]
nearer = "n\\'her'"
END
report office 0 --texts office.toml
n_texts=$(grep -c '^[A-Za-z_0-9]* = ' "$shipped")
says "office.toml: lacks $((n_texts - 6)) texts of the page (animation.farthest_run, animation.ground, animation.how_to, ...)"
for words in '<html lang="de">' '<a href="#maps">Karten</a>' 'der Masse bewegte sich mehr als 1 m, 50 % mehr als 20 m<' \
  '<th class="n">Stöße</th>' '<th class="n">verließen das Gelände</th>' '<th class="n">Zahl</th>' 'did not move: no block by more than'; do
  grep -qF "$words" office.html || fail "the page does not say: $words"
done
grep -qF "aria-label=\"n\\\\\\'her\\'\"" office.html || fail 'words break the script of the maps'

sections=$(grep -o '<section id="[a-z]*"' office.html | tr -d '\n')
[ "$sections" = '<section id="maps"<section id="result"<section id="health"<section id="runout"<section id="provenance"' ] ||
  fail "the sections stand in another order: $sections"

# refused TEXT MESSAGE
refused() {
  printf '%b' "$1" >wrong.toml
  report wrong 1 --texts wrong.toml
  says "$2"
  nothing_left wrong.html
}
refused '[maps]\n\ntitel = "Karten"' 'wrong.toml:3: maps.titel: is not a key of these texts'
says 'did you mean maps.title?'
refused 'maps.plan = "Lauf {lauf}"' 'wrong.toml:1: maps.plan: has {lauf}, which is not a value of this text'
says 'its values: {interval}, {run}'
refused '[maps]\ntitle = "Karten' 'wrong.toml:2: '
talus-report --describe json >out.json
grep -q '"--texts"' out.json || fail '--texts is not described'
