# Options of all tools beside those that every tool has, and the message for one that is gone.
# For each new option another one goes. Options that several tools declare in one place
# count once.
command -v python3 >/dev/null || skip "needs python3"
for tool in batch blocks calibrate check dda export fence fence-search hazard import maps places profile reduce report runout runs site source stability tin trace trn verify; do
  talus-$tool --describe json >"$tool.json"
done
python3 - <<'PY' || fail "there are more options than before"
import glob, json
of = {file[:-5]: {(option["spelling"], option["help"]) for option in json.load(open(file))["options"] if not option["positional"]}
      for file in glob.glob("*.json")}
n = len(set().union(*of.values()))
print(n, "options:", ", ".join(f"{tool} {len(of[tool])}" for tool in sorted(of)))
assert n <= 164, n
PY
expect 2 talus-dda site.toml --law paper
says "hint: --law is gone: write --set solver.law=VALUE"
expect 2 talus-maps run.h5 --png=yes
says "hint: --png is gone: write --pages png"
expect 2 talus-tin map.gpkg --law paper -o tin.ply # which never had it
says "hint: talus-tin --help"
expect 2 talus-maps runs --trn bed.tif --only-case low
says "hint: --only-case is gone: write the folder of the case"
