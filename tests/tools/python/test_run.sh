# Runs made from Python: the bytes of those of a shell, progress, messages, interruption.
. "$source_dir/tests/tools/talus-dda/common.sh"
python=/usr/bin/python3
$python -c 'import netCDF4, pandas, xarray' ||
  fail "python3-netcdf4, -pandas or -xarray is missing: sh pipelines/install_packages.sh test"
PYTHONPATH=$source_dir/python
export PYTHONPATH
make_inputs
expect 0 run_dda -o shell.h5 -q --set solver.duration_s=3 --set ground.ground.friction_deg=25

expect 0 $python - <<'PY'
import os, signal, threading, warnings
import talus

site = talus.Site("site.toml", solver__duration_s=3)
made = "slope.tif", "blocks.h5"
shares = []
with warnings.catch_warnings(record=True) as said:
    warnings.simplefilter("always")
    run = talus.run(site, *made, "python.h5", "--no-db", solver__blocks="alone", progress=shares.append,
                    ground__ground__friction_deg=25)
assert any("move as if each were alone" in str(words.message) for words in said), said
assert run.settings["solver"]["duration_s"] == 3 and run.settings["ground"]["ground"]["friction_deg"] == 25
assert "ground.ground.friction_deg" not in site.keys
assert shares == sorted(shares) and shares[-1] == 1, shares

try:
    talus.run(site, *made, "bad.h5", solver__duration_s=-1)
    raise SystemExit("a duration of -1 s was taken")
except ValueError as error:
    assert "solver.duration_s is -1, expected above 0" in str(error), error
try:
    talus.run(site, *made, "python.h5")
    raise SystemExit("a run was written over")
except ValueError as error:
    assert "exists already" in str(error), error

# a limit of the health that is broken: the run is there, and says so
warnings.simplefilter("ignore")
lost = talus.run(site, *made, "lost.h5", "--no-db", solver__blocks="alone", solver__duration_s=20,
                 ground__ground__friction_deg=0, solver__max_lost_share=0)
assert lost.attrs["status"] == "failed" and "left the terrain" in lost.attrs["reason"], lost.attrs["reason"]

# Ctrl-C, and exceptions of progress: the checkpoint is written, and the run continues from there
class Enough(Exception):
    pass

def stop(share):
    raise Enough

def interrupt(share):
    os.kill(os.getpid(), signal.SIGINT)

long = site.with_keys(solver__duration_s=8, solver__time_step_s=1e-5)
for out, callback, what in (("stopped.h5", stop, Enough), ("interrupted.h5", interrupt, KeyboardInterrupt)):
    try:
        talus.run(long, *made, out, progress=callback)
        raise SystemExit(f"{out} was not interrupted")
    except what:
        assert os.path.exists(out + ".part") and not os.path.exists(out), out
assert talus.open_run("stopped.h5.part").attrs["status"] == "running"
PY
cmp shell.h5 python.h5 || fail "a run made from Python differs from that of a shell"
[ ! -e bad.h5 ] || fail "bad.h5 was left behind"
exit 0
