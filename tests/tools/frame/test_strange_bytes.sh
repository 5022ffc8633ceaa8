# No byte of a stranger reaches a terminal, a table or JSON raw: neither control characters of a
# terminal nor bytes that are not UTF-8, from names of files, site files and registries.
command -v gdal_translate >/dev/null || skip "needs gdal-bin"
command -v python3 >/dev/null || skip "needs python3"
escape=$(printf '\033')
# clean FILE...: UTF-8 without control characters
clean() {
  python3 - "$@" <<'END' || fail "raw bytes in $*"
import sys
for name in sys.argv[1:]:
    text = open(name, "rb").read().decode("utf-8")
    bad = [c for c in text if c not in "\n\t" and (ord(c) < 32 or 127 <= ord(c) < 160 or c in "\u202e\u2066")]
    if bad:
        sys.exit("%s: %r" % (name, bad))
END
}
# a name from an old archive, and one that ends a line of a terminal's title
old=$(printf 'h\366hen')
printf hello >"$old.txt"
expect 0 frame-probe "$old.txt" -o "out $old.txt" --json
clean out err
prints '"doubts"'
expect 1 frame-probe "$old.txt" -o "out $old.txt" --label "$escape[2J"
says 'out h\xf6hen.txt: exists already'
clean out err
expect 1 frame-probe "$old.txt" -o "out $old.txt" --messages json
clean out err
python3 -c 'import json; [json.loads(line) for line in open("err")]' || fail "no JSON: $(cat err)"
expect 0 frame-probe "$old.txt" -o "out $old.txt" --overwrite --progress plain --label "$escape[2J" --mode copy
clean out err
expect 0 talus-runs list
clean out
expect 0 talus-runs show 1 --json
clean out
expect 0 talus-runs trace "out $old.txt" --prov
clean out
python3 -c 'import json; json.load(open("out"))' || fail "no JSON: $(cat out)"
expect 2 frame-probe "$old.txt" -o x.txt --"$escape[2J"
clean out err

awk 'BEGIN { print "ncols 24\nnrows 24\nxllcenter 500000\nyllcenter 5200000\ncellsize 2"
  for (r = 0; r < 24; r++) { line = ""; for (c = 0; c < 24; c++) line = line " " 100 - r; print line } }' >slope.asc
gdal_translate -q -ot Float64 -a_srs EPSG:32633 slope.asc "$old.tif"
expect 0 talus-trn "$old.tif" -o trn.tif --report trn.json --no-db
clean out err trn.json
python3 -c 'import json; json.load(open("trn.json"))' || fail "no JSON"

# words of a site file: names, values, keys, in the file and in the output of --print-config
n=0
for lines in '[ground."a\u001b]0;title\u0007\u001b[2Jb"]' '[blocks.a]\nfile = "\u001b[31mnone.obj"' \
  '[blocks.a]\nshape = "\u202exob"' 'crs = "\u001b[2J"' '"\u001b[2Jfoo" = 3' '[blocks."a\nb"]\nshape = "box"'; do
  n=$((n + 1))
  { printf '[site]\nname = "x"\n'; printf '%s\n' "$lines" | sed 's/\\n/\n/; t; s/$//'; } >"$n.toml"
  expect 1 talus-blocks $n.toml --trn trn.tif -o b.h5 --no-db
  clean out err
done
printf '[site]\nname = "a\\u001b[2J\\u202eb"\n[blocks.a]\nshape = "box"\nsize_m = [1, 1, 1]\nposition_m = [500020, 5200020]\n' >named.toml
expect 0 talus-blocks named.toml --trn trn.tif -o b.h5 --footprints b.gpkg --report b.json
clean out err b.json
expect 0 talus-blocks named.toml --trn trn.tif -o c.h5 --print-config
clean out
expect 0 talus-runs list --json
clean out

# A word that is longer than any name of a file, before two files that are not expected.
touch a.h5 b.h5
long=$(printf '%300s' '' | tr ' ' a)
for tool in talus-runs talus-tin talus-trn; do expect 2 "$tool" "$long" show a.h5 b.h5 --no-db; done
