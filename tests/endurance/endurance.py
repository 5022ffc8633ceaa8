#!/usr/bin/env python3
"""What happens to the tools when a machine fails them: kills, signals, full disks, odd names, damaged
inputs, little memory. Every fault comes from outside (signals, mounts, limits of the process), none
from hooks in the tools. Prints a row a fault: what, times tried, survived, lost.

  endurance.py --bin DIR[:DIR] --source DIR --work DIR [--long] [--only PART,...] [--rows FILE]
               [--other LABEL=DIR[:DIR]]...

A try is survived when no output stands half-made under its final name, the registry is whole, and
the next run gives the bytes of the run that nothing happened to. Each part is a function part_*.
"""
import argparse
import errno
import filecmp
import json
import math
import os
import random
import re
import resource
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

SIMULATED_S = "1"
HOLD_NAMES = ("site.mk", "tin.json", "trn.json", "blocks.json", "runout.json", "fence.json")
NAMES_OF_LEFTOVERS = (".part-", ".h5.part")


class Job:
    """One tool on inputs made before; `words` are arguments, outputs named relative to the folder."""

    def __init__(self, name, words, again=("--overwrite",)):
        self.name, self.words, self.again = name, words, list(again)


class Bench:
    """The inputs, the jobs, and the folder of the outputs that nothing happened to."""

    def __init__(self, args):
        self.args, self.rows, self.random = args, [], random.Random(args.seed)
        self.work = Path(args.work).resolve()
        self.whole = self.work / "whole"
        self.environment = dict(os.environ, PATH=args.bin + ":" + os.environ["PATH"])
        self.environment.pop("MAKEFLAGS", None)
        self.wall_s = {}
        self.jobs = []
        self.is_sanitized = False

    # --- running -------------------------------------------------------------------------------
    def start(self, words, folder, **more):
        return subprocess.Popen(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                start_new_session=True, text=True, errors="replace",
                                env=dict(self.environment, **more.pop("env", {})), **more)

    def run(self, words, folder, **more):
        process = self.start(words, folder, **more)
        out, err = process.communicate()
        return process.returncode, out, err

    def must(self, words, folder, **more):
        code, out, err = self.run(words, folder, **more)
        if code != 0:
            sys.exit(f"{' '.join(map(str, words))}: exit code {code}\n{out}{err}")
        return out

    # --- the scene -----------------------------------------------------------------------------
    def prepare(self):
        shutil.rmtree(self.work, ignore_errors=True)
        site = self.work / "site"
        site.mkdir(parents=True)
        designed = Path(self.args.source) / "sample_sites/designed"
        shutil.copy(designed / "contours.gpkg", site)
        text = (designed / "site.toml").read_text()
        (site / "site.toml").write_text(
            text.replace("duration_s = 20", f"duration_s = {SIMULATED_S}")
                .replace("[output]", "[output]\ncheckpoint_interval_s = 0.02")
            + ("" if "[output]" in text else "\n[output]\ncheckpoint_interval_s = 0.02\n"))
        made = site / "made"
        toml, grid = str(site / "site.toml"), str(made / "bed.tif")
        window = ["--cell-size-m", "8", "--window", "500000,5200000,500224,5200320"]
        self.jobs = [
            Job("talus-site", [toml, "-o", "."]),
            Job("talus-tin", [str(site / "contours.gpkg"), "-o", "tin.ply", "--report", "tin.json",
                              "--elevation-field", "elevation_m"]),
            Job("talus-trn", [str(made / "tin.ply"), "-o", "trn.tif", "--report", "trn.json",
                              "--hillshade", "hillshade.png", *window]),
            Job("talus-blocks", [toml, "--trn", str(made / "trn.tif"), "-o", "blocks.h5", "--trn-out",
                                 "bed.tif", "--report", "blocks.json", "--footprints", "blocks.gpkg"]),
            Job("talus-dda", [toml, "--trn", grid, "--blocks", str(made / "blocks.h5"),
                              "-o", "run.h5"], ["--overwrite", "--resume"]),
            Job("talus-export", [str(made / "run.h5"), "-o", "run.xmf"]),
            Job("talus-runout", [str(made / "run.h5"), "--trn", grid, "-o", "runout.gpkg", "--json",
                                 "runout.json", "--tables", "."]),
            Job("talus-maps", [str(made / "run.h5"), "--trn", grid, "-o", ".", "--pages", "png"]),
            Job("talus-fence", [toml, str(made / "run.h5"), "--trn", grid, "-o", "fence.gpkg",
                                "--json", "fence.json", "--csv", "fence.csv"]),
        ]
        made.mkdir()
        limit = memory_limit(self, 4096)
        self.is_sanitized = self.run([self.jobs[0].name, "--version"], site, **limit)[0] != 0
        for job in self.jobs:
            folder = self.fresh(self.whole / job.name)
            begin = time.monotonic()
            self.must([job.name, *job.words], folder)
            self.wall_s[job.name] = time.monotonic() - begin
            for file in outputs_of(folder):
                shutil.copy(folder / file, made)

    def fresh(self, folder):
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder

    # --- verdicts ------------------------------------------------------------------------------
    def half_made(self, job_name, folder, names=False):
        """Files under a final name that are not those of the undisturbed run; with `names`, those
        that hold the names of inputs may differ."""
        whole = self.whole / job_name
        may_differ = HOLD_NAMES if names else ()
        return [str(f) for f in outputs_of(folder)
                if not (whole / f).exists() or
                (f not in may_differ and not filecmp.cmp(whole / f, folder / f, shallow=False))]

    def after_fault(self, job, folder):
        """What is wrong after a fault and after the run that follows it; empty: survived."""
        wrong = self.half_made(job.name, folder)
        if wrong:
            return f"half-made: {wrong}"
        bad_registry = fault_of_registry(folder / "runs.sqlite")
        if bad_registry:
            return f"registry: {bad_registry}"
        code, _, err = self.run([job.name, *job.words, *job.again], folder)
        if code != 0:
            return f"the next run ends with {code}: {err}"
        return self.not_whole(job.name, folder)

    def not_whole(self, job_name, folder, names=False):
        there, wanted = outputs_of(folder), outputs_of(self.whole / job_name)
        if there != wanted:
            return f"outputs {sorted(set(there) ^ set(wanted))} are missing or left over"
        # A kill between the last rename and the end of the hidden folder leaves that empty; the next
        # run that writes the output removes it.
        left = [str(f) for f in folder.rglob("*") if any(n in f.name for n in NAMES_OF_LEFTOVERS)
                and not (f.is_dir() and not any(f.iterdir()))]
        if left:
            return f"left behind: {left}"
        differing = self.half_made(job_name, folder, names)
        return f"other bytes: {differing}" if differing else ""

    def row(self, fault, tried, losses, note=""):
        self.rows.append((fault, tried, tried - len(losses), len(losses), note))
        print(f"{fault}: {tried} tried, {len(losses)} lost {note}", flush=True)
        for loss in losses[:5]:
            print("  LOST " + loss, flush=True)

    def times(self, short, long):
        return long if self.args.long else short


def outputs_of(folder):
    """Relative names of the files that stand under a final name, without the registry."""
    return sorted(str(f.relative_to(folder)) for f in folder.rglob("*")
                  if f.is_file() and not f.name.startswith((".", "runs.sqlite"))
                  and ".part" not in str(f.relative_to(folder)))


def fault_of_registry(path):
    if not path.exists():
        return ""
    try:
        with sqlite3.connect(path) as db:
            verdict = db.execute("PRAGMA integrity_check").fetchone()[0]
            dangling = db.execute("PRAGMA foreign_key_check").fetchall()
        return "" if verdict == "ok" and not dangling else f"{verdict} {dangling}"
    except sqlite3.DatabaseError as error:
        return str(error)


# --- the parts -------------------------------------------------------------------------------------

def interrupted_tries(bench, job, n, number):
    """n tries of sending a signal at a random moment: (tried, losses, exit codes)."""
    tried, losses, codes = 0, [], []
    longest = bench.wall_s[job.name]
    for attempt in range(4 * n):
        if tried == n:
            break
        folder = bench.fresh(bench.work / "tries" / job.name)
        process = bench.start([job.name, *job.words], folder)
        time.sleep(bench.random.uniform(0, longest))
        if process.poll() is not None:
            longest *= 0.8
            process.communicate()
            continue
        os.killpg(process.pid, number)
        process.communicate()
        tried += 1
        codes.append(process.returncode)
        wrong = bench.after_fault(job, folder)
        if wrong:
            losses.append(f"{job.name}, try {attempt}: {wrong}")
    return tried, losses, codes


def part_kill(bench):
    """kill -9 at random moments, tool by tool; then the pipeline, twice in a row."""
    for job in bench.jobs:
        tried, losses, _ = interrupted_tries(bench, job, bench.times(1, 25), signal.SIGKILL)
        bench.row(f"kill -9, {job.name}", tried, losses)
    kill_when_placed(bench)
    kill_resumed_run(bench)
    kill_pipeline(bench)


def preloaded(bench, name):
    """The library of tests/endurance/NAME.c as an environment; None where there is no C compiler."""
    if shutil.which("cc") is None:
        return None
    library = bench.work / f"{name}.so"
    source = Path(__file__).with_name(f"{name}.c")
    subprocess.run(["cc", "-shared", "-fPIC", "-O1", "-o", library, source, "-ldl"], check=True)
    return {"LD_PRELOAD": str(library)}


def record_in(folder):
    """What the registry knows of the newest run, without times: its id, files, metrics, checks."""
    with sqlite3.connect(folder / "runs.sqlite") as db:
        run, content_id = db.execute("SELECT id, content_id FROM run ORDER BY id DESC").fetchone()
        rows = [content_id]
        for table in ("run_input", "run_output"):
            rows += db.execute(f"SELECT role, sha256 FROM {table} JOIN artifact ON artifact.id = "
                               "artifact_id WHERE run_id = ? ORDER BY role, sha256", (run,)).fetchall()
        for details in ("name, value, unit FROM metric", 'name, value, "limit", pass FROM "check"'):
            rows += db.execute(f"SELECT {details} WHERE run_id = ? ORDER BY name", (run,)).fetchall()
    return rows


def kill_when_placed(bench):
    """kill -9 between an output's coming in place and the end of the run: what stands there has its
    whole record, down to the limits of the run's health."""
    fault, preload = "kill -9 right after an output stands", preloaded(bench, "kill_when_placed")
    if preload is None:
        return bench.row(fault, 0, [], "no C compiler here")
    tried, losses = 0, []
    for job in bench.jobs:
        whole = bench.whole / job.name
        placed = outputs_of(whole)
        for file in placed if bench.args.long else bench.random.sample(placed, 1):
            folder = bench.fresh(bench.work / "tries" / job.name)
            code, _, err = bench.run([job.name, *job.words], folder,
                                     env={**preload, "KILL_WHEN_PLACED": Path(file).name})
            wrong = "" if code == -signal.SIGKILL else f"exit code {code}: {err}"
            if not wrong and record_in(folder) != record_in(whole):
                wrong = f"the record is {record_in(folder)}, whole: {record_in(whole)}"
            wrong = wrong or bench.after_fault(job, folder)
            tried += 1
            if wrong:
                losses.append(f"{job.name}, {file}: {wrong}")
    bench.row(fault, tried, losses, "with the whole record of the run")


def kill_resumed_run(bench):
    """A slide of touching blocks that is killed again and again, each time going on where it was."""
    job = next(j for j in bench.jobs if j.name == "talus-dda")
    losses, kills, n_resumed = [], 0, 0
    for _ in range(bench.times(1, 12)):
        folder = bench.fresh(bench.work / "tries/resumed")
        pause, was_killed = bench.wall_s[job.name] / 3, False
        while True:
            process = bench.start([job.name, *job.words, *job.again], folder)
            time.sleep(bench.random.uniform(0.3, 1) * pause)
            if process.poll() is not None:
                process.communicate()
                if was_killed or process.returncode != 0:
                    break
                folder = bench.fresh(folder)  # faster than when it was timed
                pause /= 4
                continue
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            was_killed = True
            kills += 1
            n_resumed += (folder / "run.h5.part").exists()
            pause *= 1.1  # so that it comes to an end
        wrong = bench.not_whole(job.name, folder) if process.returncode == 0 else process.returncode
        if wrong:
            losses.append(f"resumed slide: {wrong}")
    bench.row("kill -9, one slide several times, --resume", kills, losses,
              f"{bench.times(1, 12)} slides of 39 blocks in contact, {n_resumed} times from a checkpoint")


def pipeline_folder(bench, name):
    folder = bench.fresh(bench.work / name)
    for file in ("contours.gpkg", "site.toml"):
        shutil.copy(bench.work / "site" / file, folder)
    (folder / "Makefile").write_text(f"include {bench.args.source}/pipelines/site.mk\n")
    return folder


def make(*words):
    return ["make", "BIN=", *words]


def kill_pipeline(bench):
    if shutil.which("make") is None:
        return bench.row("kill -9, pipeline", 0, [], "no make here")
    reference = pipeline_folder(bench, "whole/pipeline")
    begin = time.monotonic()
    bench.must(make(), reference)
    wall_s, kills, losses = time.monotonic() - begin, 0, []
    for _ in range(bench.times(1, 10)):
        folder = pipeline_folder(bench, "tries/pipeline")
        pause = wall_s / 4
        while True:
            process = bench.start(make("-j2"), folder)
            time.sleep(bench.random.uniform(0.1, 1) * pause)
            if process.poll() is not None:
                out, err = process.communicate()
                break
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            kills += 1
            pause *= 1.1
            bad = fault_of_registry(folder / "out/runs.sqlite")
            if bad:
                losses.append(f"pipeline: registry: {bad}")
        if process.returncode != 0:
            losses.append(f"pipeline ends with {process.returncode}: {err[-500:]}")
            continue
        there, wanted = outputs_of(folder / "out"), outputs_of(reference / "out")
        if there != wanted:
            losses.append(f"pipeline: {sorted(set(there) ^ set(wanted))}")
        # stages/made: a line for each time that a run was made
        differing = [f for f in there if not f.startswith("stages/made/")
                     and not filecmp.cmp(folder / "out" / f, reference / "out" / f, shallow=False)]
        if differing:
            losses.append(f"pipeline: other bytes: {differing}")
    bench.row("kill -9, whole pipeline (make -j2)", kills, losses)


def part_signal(bench):
    """SIGINT, SIGTERM and SIGHUP: exit code 130 (before a tool listens: death by the signal), resumable."""
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        tried_all, losses_all, early = 0, [], 0
        for job in bench.jobs:
            tried, losses, codes = interrupted_tries(bench, job, bench.times(1, 6), number)
            for code in codes:
                if code == -number:
                    early += 1
                elif code not in (130, 0):
                    losses.append(f"{job.name}: exit code {code}")
            tried_all += tried
            losses_all += losses
        bench.row(f"{signal.Signals(number).name}, all tools", tried_all, losses_all,
                  f"{early} while the program was still being loaded")


def limited(limit, value):
    def set_limit():
        resource.setrlimit(limit, (value, value))
    return set_limit


def memory_limit(bench, mb):
    """Keyword arguments of Popen; no limit for sanitized tools, which need all of the address space."""
    return {} if bench.is_sanitized else {"preexec_fn": limited(resource.RLIMIT_AS, mb << 20)}


def refused(bench, job, folder, **more):
    """Runs a job that cannot succeed: (exit code, what is wrong; empty: a clear error)."""
    code, _, err = bench.run([job.name, *job.words], folder, **more)
    if code == 0:
        return code, bench.not_whole(job.name, folder)
    if code != 1:
        return code, f"exit code {code}: {err}"
    return code, "" if f"{job.name}: " in err else f"no error is told: {err}"


def sweep(bench, fault, jobs, settings):
    """Each job under each setting, (label, keyword arguments of Popen) each; then undisturbed."""
    tried, losses, failed = 0, [], 0
    for job in jobs:
        for label, more in settings(job):
            folder = bench.fresh(bench.work / "tries" / job.name)
            code, wrong = refused(bench, job, folder, **more)
            wrong = wrong or bench.after_fault(job, folder)
            tried += 1
            failed += code != 0
            if wrong:
                losses.append(f"{job.name}, {label}: {wrong}")
    bench.row(fault, tried, losses, f"{failed} ended with an error")


def part_limit(bench):
    """Limits of the process: size of files, number of open files, missing proj.db."""
    def sizes(job):
        largest = max((bench.whole / job.name / f).stat().st_size
                      for f in outputs_of(bench.whole / job.name))
        for size in bench.times((largest // 2,), sorted({0, 4096, 65536, largest // 2, largest - 1})):
            if size < largest:
                yield f"files up to {size} bytes", {"preexec_fn": limited(resource.RLIMIT_FSIZE, size)}

    def files(job):
        for n in bench.times((8,), (4, 5, 6, 7, 8, 9, 10, 12, 14, 16, 20)):
            yield f"{n} open files", {"preexec_fn": limited(resource.RLIMIT_NOFILE, n)}

    def no_proj(job):
        empty = bench.work / "empty"
        empty.mkdir(exist_ok=True)
        yield "no proj.db", {"env": {"PROJ_LIB": str(empty), "PROJ_DATA": str(empty)}}

    sweep(bench, "limit of file sizes (ulimit -f)", bench.jobs, sizes)
    sweep(bench, "limit of open files (ulimit -n)", bench.jobs, files)
    sweep(bench, "no proj.db", bench.jobs, no_proj)


def part_write(bench):
    """One write that fails, or all from one on, at a random place: tests/endurance/failing_write.c."""
    preload, report = preloaded(bench, "failing_write"), bench.work / "n_writes"
    if preload is None:
        return bench.row("a write that fails", 0, [], "no C compiler here")

    def places(job):
        bench.must([job.name, *job.words], bench.fresh(bench.work / "tries" / job.name),
                   env={**preload, "FAIL_REPORT": str(report)})
        n_writes = int(report.read_text())
        for k in range(bench.times(2, 30)):
            after = bench.random.randrange(n_writes)
            count, number = k % 2, errno.EIO if k % 4 < 2 else errno.ENOSPC
            yield (f"{'one' if count else 'all'} from write {after} of {n_writes}, errno {number}",
                   {"env": {**preload, "FAIL_AFTER": str(after), "FAIL_COUNT": str(count),
                            "FAIL_ERRNO": str(number)}})

    sweep(bench, "a write that fails", bench.jobs, places)


def loads_at_mb(bench, job):
    """Address space in which the tool and its libraries are loaded: --version works."""
    def loads(mb):
        return bench.run([job.name, "--version"], bench.work, **memory_limit(bench, mb))[0] == 0

    too_little, enough = 16, 4096
    if not loads(enough):
        sys.exit(f"{job.name} cannot be loaded")
    while enough - too_little > 16:
        mb = (too_little + enough) // 2
        too_little, enough = (too_little, mb) if loads(mb) else (mb, enough)
    return enough


def part_memory(bench):
    """Little address space (ulimit -v), from what loading takes upwards: done, or a clear error."""
    if bench.is_sanitized:
        return bench.row("little memory (ulimit -v)", 0, [], "not with sanitized tools")

    def sizes(job):
        least = loads_at_mb(bench, job)
        for more in bench.times((16,), (2, 4, 8, 12, 16, 24, 32, 40, 48, 64, 96, 128, 256)):
            yield f"{least + more} MB", memory_limit(bench, least + more)
    sweep(bench, "little memory (ulimit -v)", bench.jobs, sizes)
    stated_memory(bench)


# What the pages state beyond what loading takes: of the small scene in all, GDAL's cache [MB]; of a run
# of many frames, bytes a block and frame; of the registry, bytes a run listed.
SMALL_SCENE_MB = 16
PAGES_MB = 350  # of a tool that draws map pages or a report
GDAL_CACHE_MB = 128
LARGE_NODES = (1400, 2000)
MANY_FRAMES, FRAME_INTERVAL_S = 10001, 0.002
BYTES_A_BLOCK_AND_FRAME = {"talus-dda": 300, "talus-runout": 80, "talus-fence": 80, "talus-report": 150}
MANY_RUNS, BYTES_A_RUN = 100000, 4096
MANY_CONTOURS, POINTS_A_CONTOUR, BYTES_A_POINT = 200, 1000, 210


def stated_memory(bench):
    """Each tool does its work within what its page says, as a limit of the address space."""
    losses, tried = [], 0
    for job, mb in stated_limits(bench):
        limit = loads_at_mb(bench, job) + mb
        folder = bench.fresh(bench.work / "tries" / job.name)
        code, _, err = bench.run([job.name, *job.words], folder, **memory_limit(bench, limit))
        tried += 1
        if code != 0:
            losses.append(f"{job.name} within {limit} MB: exit code {code}: {err}")
        elif job.name == "talus-dda":
            shutil.copy(folder / "run.h5", bench.fresh(bench.work / "many/runs") / "run_1.h5")
        elif job.name == "talus-runout":
            shutil.copy(folder / "runout.json", bench.work / "many")
    bench.row("memory as stated on the pages (ulimit -v)", tried, losses)


def stated_limits(bench):
    """Jobs, each with the memory [MB] that its page states beyond what loading takes."""
    for job in bench.jobs:
        draws = job.name == "talus-report" or any(word in ("--pages", "--change") for word in job.words)
        yield job, SMALL_SCENE_MB + (PAGES_MB if draws else 0)
    made, toml = bench.work / "site/made", str(bench.work / "site/site.toml")
    large = ["--cell-size-m", "0.16", "--window", "500000,5200000,500224,5200320"]
    yield (Job("talus-trn", [str(made / "tin.ply"), "-o", "large.tif", *large]),
           SMALL_SCENE_MB + GDAL_CACHE_MB + mb_of(8, LARGE_NODES[0] * LARGE_NODES[1]))
    yield Job("talus-verify", ["slide_20", "slide39", "-o", "."]), SMALL_SCENE_MB
    contours = cone(bench.work / "cone")
    yield (Job("talus-tin", [str(contours), "-o", "tin.ply", "--flat", "keep", "--elevation-field", "z",
                           "--crs", "EPSG:32633"]),
           SMALL_SCENE_MB + mb_of(BYTES_A_POINT, MANY_CONTOURS * POINTS_A_CONTOUR))
    with sqlite3.connect(bench.work / "many.sqlite") as db:
        many_runs(bench.whole / "talus-dda/runs.sqlite", db)
    yield (Job("talus-runs", ["list", "--db", str(bench.work / "many.sqlite")]),
           SMALL_SCENE_MB + mb_of(BYTES_A_RUN, MANY_RUNS))
    # each reads what those before it have made
    many = bench.work / "many"
    trn, run = ["--trn", str(made / "bed.tif")], str(many / "runs/run_1.h5")
    jobs = [Job("talus-dda", [toml, *trn, "--blocks", str(made / "blocks.h5"), "-o", "run.h5",
                              "--set", "solver.blocks=alone", "--set", f"output.frame_interval_s={FRAME_INTERVAL_S}", "--set",
                              f"solver.duration_s={(MANY_FRAMES - 1) * FRAME_INTERVAL_S}"]),
            Job("talus-runout", [run, *trn, "-o", "runout.gpkg", "--json", "runout.json"]),
            Job("talus-fence", [toml, run, *trn, "-o", "fence.gpkg", "--json", "fence.json"]),
            Job("talus-report", [toml, "--dir", str(many), "-o", "report.html"])]
    n_blocks = json.loads((made / "blocks.json").read_text())["n_blocks"]
    bench.fresh(many)
    for file in ("bed.tif", "trn.tif"):
        shutil.copy(made / file, many)
    for job in jobs:
        drawing = PAGES_MB if job.name == "talus-report" else 0
        yield job, SMALL_SCENE_MB + drawing + mb_of(BYTES_A_BLOCK_AND_FRAME[job.name], n_blocks * MANY_FRAMES)


def mb_of(n_bytes, n):
    return -(-n_bytes * n // (1 << 20))


def cone(name):
    """Contours of a cone, a metre apart, as a file that GDAL reads line by line."""
    ring = [2 * math.pi * k / POINTS_A_CONTOUR for k in range(POINTS_A_CONTOUR)] + [0]
    with open(name.with_suffix(".geojsonl"), "w") as file:
        for radius in range(2, MANY_CONTOURS + 2):
            points = [[round(5e5 + radius * math.cos(a), 3), round(5.2e6 + radius * math.sin(a), 3)]
                      for a in ring]
            json.dump({"type": "Feature", "properties": {"z": 500 - radius},
                       "geometry": {"type": "LineString", "coordinates": points}}, file)
            file.write("\n")
    return name.with_suffix(".geojsonl")


def many_runs(registry, db):
    """A registry of MANY_RUNS rows, all those of the newest run of another one."""
    with sqlite3.connect(registry) as source:
        source.backup(db)
    columns = [row[1] for row in db.execute("PRAGMA table_info(run)") if row[1] != "id"]
    row = db.execute(f"SELECT {', '.join(columns)} FROM run ORDER BY id DESC").fetchone()
    db.execute("DELETE FROM run")
    db.executemany(f"INSERT INTO run ({', '.join(columns)}) VALUES ({', '.join('?' * len(columns))})",
                   [row] * MANY_RUNS)


def part_disk(bench):
    """A full disk: tmpfs of all sizes up to what is needed, then made larger. A read-only folder."""
    if os.environ.get("TALUS_OWN_MOUNTS") != "1":
        enter_own_mounts(bench)
        return
    tried, losses = 0, []
    for job in bench.jobs:
        whole = bench.whole / job.name
        needed = sum((whole / f).stat().st_size for f in outputs_of(whole)) // 1024 + 400
        n = bench.times(2, 25)
        for kb in (max(4, needed * k // n) for k in range(n)):
            _, wrong = on_a_disk(bench, job, f"size={kb}k", "size=256m")
            tried += 1
            if wrong:
                losses.append(f"{job.name}, {kb} KB: {wrong}")
    bench.row("full disk (tmpfs)", tried, losses)
    losses = []
    for job in bench.jobs:
        code, wrong = on_a_disk(bench, job, "ro", "rw")
        wrong = wrong or ("" if code == 1 else f"exit code {code}")
        if wrong:
            losses.append(f"{job.name}: {wrong}")
    bench.row("read-only folder", len(bench.jobs), losses)


def on_a_disk(bench, job, fault, mended):
    """A job on a tmpfs mounted with the option `fault`, again with `mended`: (exit code of the
    first, what is wrong)."""
    disk = bench.fresh(bench.work / "disk")
    mount("-t", "tmpfs", "-o", fault, "none", disk)
    code, wrong = refused(bench, job, disk)
    mount("-o", "remount," + mended, disk)
    wrong = wrong or bench.after_fault(job, disk)
    subprocess.run(["umount", "-l", disk], check=True)
    return code, wrong


def mount(*words):
    subprocess.run(["mount", *words], check=True)


def enter_own_mounts(bench):
    """Repeats this part in a mount namespace of its own, where tmpfs may be mounted."""
    own = ["unshare", "-m"] if os.geteuid() == 0 else ["unshare", "-rm"]
    rows = bench.work / "disk.rows"
    if subprocess.run([*own, "true"], capture_output=True).returncode != 0:
        bench.row("full disk (tmpfs)", 0, [], "no mount namespace here")
        return
    words = [*own, sys.executable, __file__, "--bin", bench.args.bin, "--source", bench.args.source,
             "--work", str(bench.work / "mounts"), "--only", "disk", "--rows", str(rows),
             "--seed", str(bench.args.seed)] + (["--long"] if bench.args.long else [])
    subprocess.run(words, env=dict(os.environ, TALUS_OWN_MOUNTS="1"))
    for line in rows.read_text().splitlines():
        fault, tried, survived, lost, note, _ = line.split("\t")
        bench.rows.append((fault, int(tried), int(survived), int(lost), note))


ODD_NAMES = ["two words", "it's a \"quote\"", "Hänge über Tal", "a\nnew line", "$(touch hurt)",
             "a;touch hurt", "-q", "100% #1 [x]*?", "ß" * 60]


def part_names(bench):
    """Odd names of folders, inputs and outputs: the same bytes, and nothing else is done."""
    tried, losses = 0, []
    for name in bench.times(ODD_NAMES[1:4], ODD_NAMES):
        for job in bench.jobs:
            folder = bench.fresh(bench.work / "tries" / name)
            words = []
            for word in job.words:  # inputs are read from the odd folder, too
                if word.startswith("/"):
                    own = folder / "in" / Path(word).name
                    own.parent.mkdir(exist_ok=True)
                    shutil.copy(word, own)
                    if word.endswith(".toml"):
                        shutil.copy(bench.work / "site/contours.gpkg", own.parent)
                    word = str(own)
                words.append(word)
            out = bench.fresh(folder / "out")
            code, _, err = bench.run([job.name, *words], out)
            if code == 1 and job.name == "talus-site" and "cannot stand in a makefile" in err:
                wrong = ""
            else:
                wrong = f"exit code {code}: {err}" if code else bench.not_whole(job.name, out, names=True)
            wrong = wrong or fault_of_registry(out / "runs.sqlite")
            code, _, err = bench.run(["talus-runs", "list", "--db", str(out / "runs.sqlite")], out)
            if code != 0:
                wrong = wrong or f"talus-runs list: {err}"
            if list(bench.work.rglob("hurt")):
                wrong = "a name was carried out as a command"
            tried += 1
            if wrong:
                losses.append(f"{job.name} in {name!r}: {wrong}")
            shutil.rmtree(folder)
    bench.row("odd names of files and folders", tried, losses)


def part_sources(bench):
    """Inputs cut short or with bytes changed: done or refused, never a crash or a hang."""
    tried, losses, refusals = 0, [], 0
    for job in bench.jobs:
        inputs = [w for w in job.words if w.startswith("/")]
        for k in range(bench.times(2, 30)):
            folder = bench.fresh(bench.work / "tries/damaged")
            victim = bench.random.choice(inputs)
            damaged = folder / "in" / Path(victim).name
            damaged.parent.mkdir()
            bytes_ = bytearray(Path(victim).read_bytes())
            if k % 2 == 0:
                bytes_ = bytes_[:bench.random.randrange(len(bytes_))]
            else:
                for _ in range(bench.random.choice((1, 8, 64))):
                    bytes_[bench.random.randrange(len(bytes_))] = bench.random.randrange(256)
            damaged.write_bytes(bytes_)
            if victim.endswith(".toml"):
                shutil.copy(bench.work / "site/contours.gpkg", damaged.parent)
            words = [str(damaged) if w == victim else w for w in job.words]
            process = bench.start([job.name, *words, "--no-db"], bench.fresh(folder / "out"),
                                  **memory_limit(bench, 4096))
            try:
                # what is cut from a site file may leave a longer run; sanitized tools are slow at it
                _, err = process.communicate(timeout=1200 if bench.is_sanitized else 120)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                process.communicate()
                losses.append(f"{job.name}: no end with damaged {victim}")
                continue
            tried += 1
            refusals += process.returncode == 1
            if process.returncode not in (0, 1, 3):
                keep = bench.work / f"lost_{job.name}_{k}{Path(victim).suffix}"
                keep.write_bytes(bytes_)
                losses.append(f"{job.name}: exit code {process.returncode} with {keep}: {err[-300:]}")
            elif process.returncode == 1 and outputs_of(folder / "out"):
                losses.append(f"{job.name}: outputs of a refused input")
    bench.row("damaged inputs", tried, losses, f"{refusals} refused")
    lying_sources(bench)


LIES = {
    "rows.asc": "ncols 100000\nnrows 100000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n",
    "huge.vrt": '<VRTDataset rasterXSize="2000000000" rasterYSize="2000000000"><GeoTransform>0,1,0,0,0,-1'
                '</GeoTransform><VRTRasterBand dataType="Float64" band="1"/></VRTDataset>',
    "large.vrt": '<VRTDataset rasterXSize="60000" rasterYSize="60000"><GeoTransform>0,1,0,0,0,-1'
                 '</GeoTransform><VRTRasterBand dataType="Float64" band="1"/></VRTDataset>',
    "count.ply": "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty double x\n"
                 "property double y\nproperty double z\nelement face 4000000000\n"
                 "property list uchar int vertex_indices\nend_header\n",
}


def lying_sources(bench):
    """Small files that claim to be huge: refused, within 4 GB of address space."""
    losses = []
    for name, content in LIES.items():
        folder = bench.fresh(bench.work / "tries/lies")
        (folder / name).write_text(content)
        job = Job("talus-trn", [name, "-o", "trn.tif", "--crs", "EPSG:32633", "--no-db"])
        code, _, err = bench.run([job.name, *job.words], folder, **memory_limit(bench, 4096))
        if code != 1 or (folder / "trn.tif").exists():
            losses.append(f"{name}: exit code {code}: {err}")
    bench.row("inputs that lie about their size", len(LIES), losses)


def part_registry(bench):
    """Two writers of one registry: every run has its row."""
    folder = bench.fresh(bench.work / "registry")
    (folder / "in.txt").write_text("hello")
    n = bench.times(40, 5000)
    loop = (f'i=0; while [ $i -lt {n} ]; do i=$((i+1)); frame-probe in.txt -o $0.txt --db shared.sqlite'
            ' -q --overwrite || echo $i >>failed; done')
    writers = [bench.start(["sh", "-c", loop, name], folder) for name in ("a", "b")]
    errors = [w.communicate()[1] for w in writers]
    with sqlite3.connect(folder / "shared.sqlite") as db:
        done = db.execute("SELECT count(*) FROM run WHERE status = 'done'").fetchone()[0]
        linked = db.execute("SELECT count(*) FROM run_output").fetchone()[0]
    losses = [f"{2 * n - done} rows, {2 * n - linked} outputs are missing: {errors}"] * (
        max(2 * n - done, 2 * n - linked))
    if (folder / "failed").exists() or fault_of_registry(folder / "shared.sqlite"):
        losses.append(f"turned away, or registry broken: {errors}")
    bench.row("two writers of one registry", 2 * n, losses)


def part_many(bench):
    """A site of many fences and objects: everything that make computes, and each of them in the results."""
    n_fences, n_objects = bench.times(30, 1000), bench.times(150, 5000)
    folder = bench.fresh(bench.work / "many_lines")
    designed = Path(bench.args.source) / "sample_sites/designed"
    shutil.copy(designed / "contours.gpkg", folder)
    (folder / "Makefile").write_text(f"include {bench.args.source}/pipelines/site.mk\n")
    text = (designed / "site.toml").read_text().split("[fence.")[0]
    with open(folder / "site.toml", "w") as site:
        site.write(text.replace("duration_s = 20", f"duration_s = {SIMULATED_S}"))
        for i in range(n_fences):
            x, y = 500005 + 214 * (i % 40) / 40, 5200010 + 220 * (i // 40) / max(1, n_fences // 40)
            site.write(f"\n[fence.f{i}]\nline = [[{x:.2f}, {y:.2f}], [{x + 4:.2f}, {y:.2f}]]\n"
                       "height_m = 4\ncapacity_kj = 3000\n")
        for i in range(n_objects):
            x, y = 500005 + 210 * (i % 100) / 100, 5200010 + 280 * (i // 100) / max(1, n_objects // 100)
            site.write(f"\n[object.o{i}]\npolygon = [[{x:.2f}, {y:.2f}], [{x + 1.5:.2f}, {y:.2f}], "
                       f"[{x + 1.5:.2f}, {y + 3:.2f}]]\n")
    tools = Path(shutil.which("talus-dda", path=bench.environment["PATH"])).parent
    code, _, err = bench.run(["make", "-s", f"BIN={tools}/", "RUNS=2", "all"], folder)
    losses = [f"make ends with {code}: {err[-800:]}"] if code not in (0, 3) else []
    for file, key, n in (("fence.json", "fences", n_fences), ("trace.json", "objects", n_objects)):
        path = folder / "out" / file
        found = len(json.loads(path.read_text())[key]) if path.exists() else 0
        if found != n:
            losses.append(f"{file} has {found} of {n} {key}")
    bench.row("many fences and objects, all that make computes", 1, losses[:1],
              f"{n_fences} and {n_objects}; {'; '.join(losses[1:])}".rstrip("; "))


def part_same(bench):
    """Determinism: repeated, with other numbers of threads, in another place, by another build."""
    variants = [("again, 1 thread", {"GDAL_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}, None),
                ("2 threads", {"GDAL_NUM_THREADS": "2", "OMP_NUM_THREADS": "2"}, None),
                ("locale and time zone", {"LC_ALL": "de_DE.UTF-8", "TZ": "Asia/Tokyo"}, None)]
    variants += [(label, {}, bin) for label, bin in (o.split("=", 1) for o in bench.args.other)]
    for label, environment, other in variants:
        losses = []
        for job in bench.jobs:
            if other:
                environment = {"PATH": other + ":" + os.environ["PATH"]}
            folder = bench.fresh(bench.work / "tries" / "a folder elsewhere")
            code, _, err = bench.run([job.name, *job.words], folder, env=environment)
            wrong = f"exit code {code}: {err}" if code else bench.not_whole(job.name, folder)
            if wrong:
                losses.append(f"{job.name}: {wrong}")
        bench.row(f"same bytes: {label}", len(bench.jobs), losses)
    same_tables_at_other_frames(bench)


def values_of(raster):
    """Checksums of the bands of a raster."""
    said = subprocess.run(["gdalinfo", "-checksum", raster], check=True, capture_output=True, text=True)
    return [line for line in said.stdout.splitlines() if "Checksum=" in line]


def same_tables_at_other_frames(bench):
    """Maps and fence tables do not depend on the interval of frames."""
    dda = next(j for j in bench.jobs if j.name == "talus-dda")
    losses = []
    intervals = ("0.02", "0.37")
    for interval in intervals:
        folder = bench.fresh(bench.work / f"frames_{interval}")
        bench.must([dda.name, *dda.words, "--set", f"output.frame_interval_s={interval}"], folder)
        grid = bench.work / "site/made/bed.tif"
        bench.must(["talus-maps", "run.h5", "--trn", grid, "-o", "maps", "--pages", "png"], folder)
        bench.must(["talus-fence", bench.work / "site/site.toml", "run.h5", "--trn", grid, "-o",
                    "fence.gpkg", "--csv", "fence.csv"], folder)
    one, two = (bench.work / f"frames_{i}" for i in intervals)
    for file in outputs_of(one):
        # pages hold the numbers of their runs: of maps the values count
        same = values_of if file.endswith(".tif") else without_ids
        if file.endswith((".tif", ".qml", ".csv")) and same(one / file) != same(two / file):
            losses.append(f"{file} depends on the interval of frames")
    losses += [f"{f.name}: pixels depend on the interval of frames" for f in sorted((one / "maps").glob("*.tif"))
               if pixels(bench, f) != pixels(bench, two / "maps" / f.name)]
    bench.row("same maps and tables: another frame interval", len(outputs_of(one)), losses)


def without_ids(file):
    """Bytes of a file without run ids: another interval of frames is another run."""
    return re.sub(rb"\b[0-9a-f]{16}\b", b"ID", file.read_bytes())


def pixels(bench, file):
    """Checksums of all bands, or nothing where GDAL's programs are missing."""
    if shutil.which("gdalinfo") is None:
        return ""
    return [line for line in bench.must(["gdalinfo", "-checksum", file], file.parent).splitlines()
            if "Checksum" in line]


PARTS = {name[5:]: value for name, value in list(globals().items()) if name.startswith("part_")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--bin", required=True, help="folders of the tools and of frame-probe")
    parser.add_argument("--other", action="append", default=[], metavar="LABEL=DIR[:DIR]",
                        help="the tools of another build, for the same bytes")
    parser.add_argument("--source", required=True, help="the repository")
    parser.add_argument("--work", required=True, help="scratch folder, emptied")
    parser.add_argument("--long", action="store_true", help="hundreds of tries instead of a few")
    parser.add_argument("--only", default=",".join(PARTS), help="of " + ",".join(PARTS))
    parser.add_argument("--rows", help="file to write the table to, tab-separated")
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()
    bench = Bench(args)
    bench.prepare()
    for name in args.only.split(","):
        PARTS[name](bench)
    if args.rows:
        commit = re.search(r"\((.*)\)", bench.must(["talus-runs", "--version"], bench.work)).group(1)
        Path(args.rows).write_text(
            "".join("\t".join(map(str, (*row, commit))) + "\n" for row in bench.rows))
    return 1 if any(row[3] for row in bench.rows) else 0


if __name__ == "__main__":
    sys.exit(main())
