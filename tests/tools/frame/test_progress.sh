# Messages of a working tool for programs: lines or objects, also without a terminal, that
# begin at once and end with all done; messages as objects.
command -v python3 >/dev/null || skip "needs python3"
printf 'hello' >in.txt
# objects FILE: each line is an object; prints them as Python lists
objects() { python3 -c 'import json, sys; print([json.loads(line) for line in open(sys.argv[1])])' "$1" || { cat "$1" >&2; fail "not an object a line"; }; }

# a tool that does one thing only
expect 0 frame-probe in.txt -o a.txt --progress=json -q
[ "$(objects err)" = "[{'progress': 1.0, 'eta_s': 0}]" ] || fail "the end is told as $(cat err)"
expect 0 frame-probe in.txt -o a.txt --overwrite --progress=plain -q
[ "$(cat err)" = "100 %" ] || fail "the end is told as $(cat err)"
for form in auto none; do
  expect 0 frame-probe in.txt -o a.txt --overwrite --progress=$form -q
  [ ! -s err ] || fail "--progress=$form -q says $(cat err)"
done
expect 2 frame-probe in.txt -o a.txt --progress=loud

# one that takes its time, seen while it runs
: >lines
frame-probe in.txt -o b.txt --mode wait --progress=json --label run_7 2>lines &
process=$!
n=0
until [ "$(grep -c eta_s lines)" -ge 3 ]; do
  n=$((n + 1))
  [ $n -lt 600 ] || fail "no progress is told while the tool works"
  sleep 0.05
done
kill -TERM $process
wait $process || true
python3 - lines <<'END' || fail "progress: $(cat lines)"
import json, sys
lines = [json.loads(line) for line in open(sys.argv[1]) if line.startswith("{")]
shares = [line["progress"] for line in lines]
assert shares[0] == 0 and shares == sorted(shares) and shares[-1] > 0, shares
assert all(line["label"] == "run_7" for line in lines)
assert "eta_s" not in lines[0] and all(isinstance(line.get("eta_s", 0), int) for line in lines)
assert any("eta_s" in line for line in lines) or shares[-1] <= 0.02
# the rest takes time in proportion to the finished part: the time so far, of which eta_s speaks,
# only grows
told = [(line["progress"], line["eta_s"]) for line in lines if "eta_s" in line]
assert all(eta > 0 for share, eta in told), told
for (share, eta), (next_share, next_eta) in zip(told, told[1:]):
    rounding = next_share / (1 - next_share)  # eta_s is in whole seconds
    assert next_eta * rounding >= eta * share / (1 - share) - rounding, told
END
: >lines
frame-probe in.txt -o b.txt --mode wait --progress=plain 2>lines &
process=$!
n=0
until [ "$(grep -c '^[0-9]* %' lines)" -ge 2 ]; do
  n=$((n + 1))
  [ $n -lt 600 ] || fail "no progress is told while the tool works"
  sleep 0.05
done
kill -TERM $process
wait $process || true
if grep -q "$(printf '\r')" lines; then fail "lines are rewritten in place where there is no terminal"; fi

# unasked: in place on a terminal; where there is none, nothing of the first minute
frame-probe in.txt -o b.txt --mode wait 2>lines &
process=$!
python3 - <<'END' || fail "a terminal is told nothing, or lines instead of one in place"
import os, pty, signal, subprocess, time
ours, theirs = pty.openpty()
tool = subprocess.Popen(["frame-probe", "in.txt", "-o", "t.txt", "--mode", "wait"], stderr=theirs)
os.close(theirs)
told = b""
end = time.monotonic() + 30
while told.count(b"\r\x1b[K") < 3 and time.monotonic() < end:
    told += os.read(ours, 4096)
tool.send_signal(signal.SIGTERM)
tool.wait()
assert told.count(b"\r\x1b[K") >= 3 and b" %" not in told, told
END
kill -TERM $process
wait $process || true
if grep -q '[0-9] %\|\.\.\.' lines; then fail "without a terminal the first seconds are told: $(cat lines)"; fi

# messages
expect 0 frame-probe in.txt -o c.txt --messages=json --progress=none
[ "$(objects err)" = "[{'level': 'warning', 'tool': 'frame-probe', 'text': 'a warning'}]" ] || fail "messages: $(cat err)"
expect 1 frame-probe in.txt -o d.txt --messages json --mode refuse --label run_7
[ "$(objects err)" = "[{'level': 'error', 'tool': 'frame-probe', 'label': 'run_7', 'text': 'in.txt:3: found a, expected b'}, {'level': 'hint', 'tool': 'frame-probe', 'label': 'run_7', 'text': 'write b'}]" ] || fail "messages: $(cat err)"
expect 3 frame-probe in.txt -o e.txt --messages=json --mode check -q
[ "$(objects err)" = "[{'level': 'error', 'tool': 'frame-probe', 'text': 'health: largest_penetration_m is 2, limit 1'}]" ] || fail "messages: $(cat err)"
expect 2 frame-probe in.txt -o h.txt --colour red --messages=json
objects err >found
grep -q "'level': 'error'.*--colour.*'level': 'hint'" found || fail "a wrong command line: $(cat err)"
expect 0 frame-probe in.txt -o f.txt --messages=json
objects err >found
grep -q "'progress': 1.0" found || fail "with messages as objects progress is one, too: $(cat err)"

# they are not settings of a run
frame-probe in.txt -o g.txt --json --no-db --messages=json --progress=json >one 2>err
frame-probe in.txt -o g.txt --json --no-db --overwrite >two 2>err
cmp one two || fail "how a tool speaks makes another run of it"

# every tool
for tool in "${bin%%:*}"/talus-*; do
  [ -x "$tool" ] && [ ! -d "$tool" ] || continue
  "$tool" --help >help
  grep -q -- '--progress.*{auto,plain,json,none}' help && grep -q -- '--messages.*{text,json}' help ||
    fail "${tool##*/} has no --progress or --messages"
done
