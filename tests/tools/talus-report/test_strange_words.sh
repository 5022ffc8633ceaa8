# Results of a stranger put words into the page and no orders: values, keys and tags of the JSON,
# labels of a style, names of the site file.
command -v python3 >/dev/null || skip "needs python3"
run-probe . 3 objects=watched
mkdir -p made/runs
mv run_*.h5 made/runs/
cp slope.tif made/trn.tif
printf '\n[hazard.class.all]\nfrequency_per_a = 0.01\n[place.house]\npolygon = [[250010, 350000], [250040, 350000], [250040, 350020]]\n' >>site.toml
expect 0 talus-runout made/runs/*.h5 --trn made/trn.tif -o made/runout.gpkg --json made/runout.json --no-db
expect 0 talus-maps made/runs/*.h5 --trn made/trn.tif -o made/maps --pages png --no-db
expect 0 talus-hazard site.toml made/runs/*.h5 --trn made/trn.tif -o made/hazard --json made/hazard.json --pages png --no-db
expect 0 talus-trace site.toml made/runs/*.h5 --trn made/trn.tif -o made/trace.gpkg --json made/trace.json --no-db
expect 0 talus-places site.toml made/runs/*.h5 --trn made/trn.tif --json made/places.json --no-db
fence=$(sed -n 's/^\[fence\.\(.*\)\]/\1/p' site.toml | head -n 1)
[ -z "$fence" ] || expect 0 talus-fence site.toml made/runs/*.h5 --trn made/trn.tif -o made/fence.gpkg --json made/fence.json --no-db

cat >spoil.py <<'END'
# spoil.py FILE HOW: puts a script into the words of FILE, a JSON or a style
import json, re, sys
name, how = sys.argv[1:]
script = "<script>PWN(1)</script>"
by_which_results_are_told = {"run_id", "RUN_ID", "RUN_SET", "run_set", "sections", "tool", "version", "case", "file"}

def spoilt(value, key=""):
    if isinstance(value, dict):
        out = {}
        for k, v in value.items():
            new = k + script if how == "keys" and key in ("verdicts", "drawn", "tags", "counts") else k
            out[new] = spoilt(v, k)
        if key == "tags":
            out.setdefault("N_MISSING", "2" + script)
            out.setdefault("REMARK", script)
        if how == "keys" and key == "runs" and "drawn" not in out:
            out["drawn"] = {"sample": 1, script: 2}
        return out
    if isinstance(value, list):
        return [spoilt(v, key) for v in value]
    if isinstance(value, str):
        return value if key in by_which_results_are_told else value + script
    if how == "numbers" and isinstance(value, (int, float)) and not isinstance(value, bool):
        return script
    return value

text = open(name).read()
if name.endswith(".json"):
    whole = json.loads(text)
    whole.setdefault("tags", {})
    if how == "keys":
        whole.setdefault("notes", [script])
    text = json.dumps(spoilt(whole))
else:
    text = re.sub('label="', 'label="' + script, text)
    if how == "keys":  # ends the layer that it is in
        text = text.replace("</qgis>", "</maplayer><Macros>PWN</Macros><maplayer></qgis>")
open(name, "w").write(text)
END
n=0
for file in runout.json hazard.json trace.json places.json fence.json maps/reach.qml hazard/class.qml; do
  [ -f made/$file ] || continue
  for how in values keys numbers; do
    rm -rf other report.html
    cp -r made other
    python3 spoil.py other/$file $how
    code=0
    talus-report site.toml --dir other -o report.html --qgis site.qgz --overwrite --no-db >out 2>err || code=$?
    [ $how = numbers ] || [ $code -eq 0 ] || { cat err >&2; fail "$file, $how: exit code $code"; }
    [ $code -eq 0 ] || continue
    n=$((n + 1))
    if grep -q '<script>PWN' report.html; then fail "a script of $file, $how: $(grep -o '.\{60\}<script>PWN' report.html | head -n 3)"; fi
    python3 -c 'import xml.dom.minidom, zipfile
z = zipfile.ZipFile("site.qgz")
for n in z.namelist():
    if n.endswith(".qgs"):
        assert not xml.dom.minidom.parseString(z.read(n)).getElementsByTagName("Macros")' ||
      fail "$file, $how: the project is no XML, or holds what a style brought"
  done
done
[ $n -ge 8 ] || fail "only $n reports were made"
