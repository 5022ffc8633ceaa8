#!/usr/bin/env python3
"""Random command lines for every tool: options of their --help with fitting, odd and wrong values,
and files that are right, damaged, of another kind, missing or folders.

  command_lines.py --bin DIR[:DIR] --source DIR --work DIR [--tries N | --seconds S] [--seed K]
                   [--tool NAME,...] [--files DIR]

Claims of each command line, whatever it says:
- it ends by itself, or within a minute of SIGTERM, with an exit code of docs/tools/common.md;
- a code other than 0 comes with a message, and no message is one of an unexpected failure;
- a file that stood there before is as it was, unless --overwrite names it; nothing temporary is left
  (tools that read a folder of runs bring its ensemble.json up to date);
- where the code is 1 or 2 no output is there, but for those that are kept to look at (--doubts).

A command line that breaks one is printed as a shell takes it, with its folder kept. Further input
files (edited runs, say) are taken from the folder of --files.
"""
import argparse
import hashlib
import os
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

EXIT_CODES = (0, 1, 2, 3)
AFTER_SIGTERM = EXIT_CODES + (130,)
WAIT_S = 30  # then SIGTERM: nothing says that a run of an hour must end sooner
LONGER_S = 120
MEMORY_BYTES = 4 << 30
# talus-verify computes for minutes: --tool verify tries it.
TOOLS = ("blocks check dda export fence hazard maps places reduce report runout runs site source tin trace "
         "trn").split()
# Kinds of options without a unit in their names. Options of --help that are not here hold words.
OUTPUTS = set("out report json csv svg run-table curves thickness trn-out footprints stereonet "
              "size-curve hillshade doubts hold-out change qgis scenarios "
              "assume-joints page".split())
OUTPUT_FOLDERS = {"rasters"}
KEPT_IF_REFUSED = {"doubts"}
INPUTS = {"trn": "trn", "bed": "trn", "blocks": "blocks", "like": "trn", "reference": "trn",
          "reference-points": "vector", "breaklines": "vector", "spots": "vector",
          "boundary": "vector", "labels": "vector", "without": "run", "compare": "run", "mobility": "table",
          "sizes": "table", "site": "site", "dir": "folder", "peers": "folder", "db": "registry",
          "source": "terrain", "contours": "vector", "run": "run", "cases": "word"}
EXTENSIONS = {"out": ".out", "json": ".json", "report": ".json"}
NUMBERS = ("0 1 -1 2 0.5 10 100 1000 1e-300 1e300 -1e300 1e-9 1e9 nan inf -inf 1e999 0x10 1,5 "
           "4294967296 9223372036854775808 -0 00012 1e +3 . - %s").split() + ["", " ", "1 2"]
WORDS = ["", " ", "a", "*", "?", "%s%n", "$(touch hurt)", "`touch hurt`", ";touch hurt", "a\nb", "\t",
         "é", "\u202e", "a" * 300, "../..", "/", "-", "--", "--help", "=", "a=b", "a=", "=b", "1=2",
         "'", '"', "[% 1 %]", "<b>", "NULL", "EPSG:32633", "EPSG:0", "EPSG:99999999", "none",
         "ellipsoidal", "+proj=utm +zone=33", "z > 0", "z = 'a", "1=1;DROP TABLE c", "elevation_m",
         "0,0,1,1", "500000,5200000,500224,5200320", "1,1,0,0", "nan,nan,nan,nan", "COMPRESS=LZW",
         "BLOCKSIZE=1", "NBITS=1", "\udcff"]


class Bench:
    def __init__(self, args):
        self.args = args
        self.random = random.Random(args.seed)
        self.work = Path(args.work).resolve()
        self.pool = self.work / "pool"
        self.environment = dict(os.environ, PATH=args.bin + ":" + os.environ["PATH"], TALUS_REGISTRY_WAIT_S="1")
        self.files = {}
        self.is_sanitized = False

    def run(self, words, folder):
        return subprocess.run(words, cwd=folder, env=self.environment, capture_output=True)

    def must(self, *words):
        result = self.run(words, self.pool)
        if result.returncode != 0:
            sys.exit(f"{shlex.join(words)}: exit code {result.returncode}\n{result.stderr.decode()}")

    # --- files ---------------------------------------------------------------------------------
    def prepare(self):
        shutil.rmtree(self.work, ignore_errors=True)
        self.pool.mkdir(parents=True)
        designed = Path(self.args.source) / "sample_sites/designed"
        shutil.copy(designed / "contours.gpkg", self.pool)
        text = (designed / "site.toml").read_text().replace("duration_s = 20", "duration_s = 0.5")
        (self.pool / "site.toml").write_text(text)
        self.must("run-probe", ".", "2", "blocks=2", "objects=watched")
        (self.pool / "site.toml").replace(self.pool / "probe.toml")
        (self.pool / "site.toml").write_text(text)
        self.must("talus-reduce", "run_0.h5", "run_1.h5", "--trn", "slope.tif", "-o", "part.h5", "--no-db")
        self.must("talus-tin", "contours.gpkg", "-o", "tin.ply", "--elevation-field", "elevation_m")
        self.must("talus-trn", "tin.ply", "-o", "trn.tif", "--cell-size-m", "8", "--window",
                  "500000,5200000,500224,5200320", "--no-db")
        self.must("talus-blocks", "site.toml", "--trn", "trn.tif", "-o", "blocks.h5", "--trn-out",
                  "bed.tif", "--no-db")
        self.must("talus-dda", "site.toml", "--trn", "bed.tif", "--blocks", "blocks.h5", "-o",
                  "run.h5", "--no-db")
        (self.pool / "table.csv").write_text("volume_m3\n1\n2\n3\n5\n8\n13\n")
        (self.pool / "points.csv").write_text("x,y,z\n500010,5200010,5\n500020,5200090,6\n")
        (self.pool / "empty").write_text("")
        (self.pool / "noise").write_bytes(self.random.randbytes(3000))
        (self.pool / "folder").mkdir()
        os.symlink("loop", self.pool / "loop")
        self.files = {
            "site": ["site.toml", "probe.toml"], "trn": ["trn.tif", "bed.tif", "slope.tif"],
            "blocks": ["blocks.h5"], "run": ["run_0.h5", "run_1.h5", "run.h5", "part.h5"],
            "vector": ["contours.gpkg", "points.csv"], "terrain": ["tin.ply", "trn.tif"],
            "table": ["table.csv"], "registry": ["runs.sqlite"],
            "folder": ["folder", "."], "word": WORDS,
            "other": ["empty", "noise", "folder", "loop", "missing", "/dev/null", "a\nb", "x" * 300]}
        for kind in ("site", "trn", "blocks", "run", "vector", "terrain"):
            self.files[kind] += [self.damaged(name) for name in list(self.files[kind])]
        for path in sorted(Path(self.args.files).iterdir()) if self.args.files else []:
            kind = {"blocks": "blocks", "run": "run", "part": "run"}.get(path.name.split("_")[0], "other")
            shutil.copy(path, self.pool)
            self.files[kind].append(path.name)
        self.digests = self.digest_of_pool()
        limit = self.run(["sh", "-c", "ulimit -v 4000000; talus-runs --version"], self.pool)
        self.is_sanitized = limit.returncode != 0

    def damaged(self, name):
        data = bytearray((self.pool / name).read_bytes())
        for _ in range(3):
            data[self.random.randrange(len(data))] ^= 1 << self.random.randrange(8)
        if self.random.random() < 0.3:
            del data[self.random.randrange(len(data)):]
        stem, dot, end = name.partition(".")
        (self.pool / f"{stem}_damaged{dot}{end}").write_bytes(data)
        return f"{stem}_damaged{dot}{end}"

    def digest_of_pool(self):
        return {path: hashlib.sha256(path.read_bytes()).digest()
                for path in sorted(self.pool.iterdir()) if path.is_file() and "runs.sqlite" not in path.name and path.name != "ensemble.json"}

    # --- command lines -------------------------------------------------------------------------
    def describe(self, tool):
        """Positionals and options of --help: (name, value) with value "" for flags."""
        text = self.run([tool, "--help"], self.pool).stdout.decode()
        positionals, options = [], []
        for line in text.splitlines():
            named = re.match(r"  (?:-\w,)?--([\w-]+)(.*)", line)
            placed = re.match(r"  (\w+) TEXT(.*)", line)
            if named and named[1] not in ("help", "version"):
                value = re.match(r"\s?(TEXT|FLOAT|INT|UINT)?(?:[:=](\S+))?|\{", named[2])
                options.append((named[1], (value[1] or "") if value else "", named[2]))
            elif placed:
                positionals.append((placed[1], "REQUIRED" in placed[2], "..." in placed[2]))
        return positionals, options

    def pick(self, kind):
        if self.random.random() < 0.12:
            kind = self.random.choice(sorted(self.files))
        name = self.random.choice(self.files.get(kind, self.files["other"]))
        return name if kind in ("word", "other") and "/" in name else f"../pool/{name}"

    def value_of(self, name, kind, rest):
        r = self.random
        choices = re.search(r"\{([\w,]+)\}", rest)
        if choices and r.random() < 0.8:
            return r.choice(choices[1].split(","))
        if name in OUTPUTS or name in OUTPUT_FOLDERS:
            odd = r.random()
            if odd < 0.05:
                return r.choice(["../pool/trn.tif", "/nonexistent/out", "-", "a\nb", "x" * 300, "", "."])
            return f"out_{name}" + EXTENSIONS.get(name, "")
        if name in INPUTS:
            return self.pick(INPUTS[name])
        if kind in ("FLOAT", "INT", "UINT") or name.split("-")[-1] in ("m", "s", "deg", "mb", "share", "seed"):
            return r.choice(NUMBERS) if r.random() < 0.5 else str(r.choice([1, 2, 5, 0.5, 20]))
        if name == "set":
            return f"{r.choice(self.keys)}={r.choice(NUMBERS + WORDS + ['[]', '[1]', '[[1, 2]]', 'true'])}"
        return r.choice(WORDS)

    def command_of(self, tool, positionals, options):
        r, words = self.random, [tool]
        for name, is_required, is_many in positionals:
            if r.random() < (0.97 if is_required else 0.85):
                words += [self.pick(INPUTS.get(name, "word")) for _ in range(r.choice([1, 1, 2, 3]) if is_many else 1)]
        if tool == "talus-runs":
            words.append(r.choice(["list", "show", "trace", "adopt", "merge", "nothing"]))
            words += [r.choice([self.pick("run"), self.pick("registry"), "1", "0", "a"]) for _ in range(r.randrange(3))]
        for name, kind, rest in options:
            is_wanted = "REQUIRED" in rest or name in ("out", "trn", "blocks")
            if r.random() > (0.93 if is_wanted else 0.12):
                continue
            words.append("--" + name)
            if kind:
                words.append(self.value_of(name, kind, rest))
        if r.random() < 0.1:
            words.insert(r.randrange(1, len(words) + 1), r.choice(WORDS + NUMBERS))
        return [word.encode(errors="surrogateescape").decode(errors="surrogateescape") for word in words if "\0" not in word]

    # --- verdicts ------------------------------------------------------------------------------
    def limits(self):
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if not self.is_sanitized:
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))

    def try_one(self, words, folder):
        """What is wrong with a command line; empty when nothing is."""
        folder.mkdir()
        process = subprocess.Popen(words, cwd=folder, env=self.environment, stdin=subprocess.DEVNULL,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, preexec_fn=self.limits)
        allowed = EXIT_CODES
        try:
            out, err = process.communicate(timeout=WAIT_S)
        except subprocess.TimeoutExpired:
            allowed = AFTER_SIGTERM
            process.send_signal(signal.SIGTERM)
            try:
                out, err = process.communicate(timeout=LONGER_S)
            except subprocess.TimeoutExpired:
                process.kill()
                process.communicate()
                return ["does not heed SIGTERM"]
        return self.faults(words, folder, process.returncode, err.decode(errors="replace"), allowed)

    def faults(self, words, folder, code, err, allowed):
        found = []
        if code not in allowed:
            found.append(f"exit code {code}")
        if code != 0 and not err.strip() and "--quiet" not in words:
            found.append(f"exit code {code} without a word")
        found += [f"says {line}" for line in err.splitlines()
                  if re.search(r"unexpected: |Assertion|assertion|terminate called|Sanitizer|runtime error", line)]
        left = sorted(path.relative_to(folder) for path in folder.rglob("*"))
        found += [f"left {path}" for path in left if ".part-" in path.name or path.name == "hurt"]
        if code in (1, 2):
            kept = {"out_" + name + EXTENSIONS.get(name, "") for name in KEPT_IF_REFUSED}
            if words[0] == "talus-check" and code == 1:  # a site that is refused has a page, too
                kept.add("out_out.out")
            found += [f"output {path} though the exit code is {code}" for path in left
                      if path.parts[0].startswith("out_") and path.name not in kept
                      and (folder / path).is_file() and "runs.sqlite" not in path.name]
        now = self.digest_of_pool()  # --db may make a registry there
        if changed := sorted(path.name for path, digest in self.digests.items() if now.get(path) != digest):
            found.append("an input was changed: " + ", ".join(changed))
        return found

    def go(self):
        self.prepare()
        keys, section = [], ""
        for line in (Path(self.args.source) / "docs/reference/site-file.md").read_text().splitlines():
            if head := re.match(r"### \[(.*)\]", line):
                section = head[1].replace("NAME", self.random.choice(["a", "J1", "rock"]))
            elif line.startswith("| `"):
                keys += [f"{section}.{key}" for key in re.findall(r"`(\w+)`", line.split(" | ")[0])]
        self.keys = keys + ["", "a", ".", "a.", "a.b.c", "solver." * 100]
        tools = {}
        for name in self.args.tool.split(",") if self.args.tool else TOOLS:
            tools["talus-" + name] = self.describe("talus-" + name)
        end = time.monotonic() + self.args.seconds if self.args.seconds else None
        codes, broken, n = {}, 0, 0
        while n < self.args.tries if end is None else time.monotonic() < end:
            tool = self.random.choice(sorted(tools))
            words = self.command_of(tool, *tools[tool])
            folder = self.work / f"try_{n}"
            n += 1
            try:
                found = self.try_one(words, folder)
            except (ValueError, OSError) as error:  # no command line at all
                found = [] if "argument list" in str(error).lower() else [str(error)]
            if found:
                broken += 1
                print(f"{folder}: {shlex.join(words)!a}\n  " + "\n  ".join(found), flush=True)
                if "an input was changed" in "".join(found):
                    self.digests = self.digest_of_pool()
            else:
                shutil.rmtree(folder, ignore_errors=True)
        print(f"{n} command lines, {broken} with faults")
        return 1 if broken else 0


def main():
    parser = argparse.ArgumentParser()
    for name in ("bin", "source", "work"):
        parser.add_argument("--" + name, required=True)
    parser.add_argument("--tries", type=int, default=60)
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--tool")
    parser.add_argument("--files")
    return Bench(parser.parse_args()).go()


if __name__ == "__main__":
    sys.exit(main())
