# A registry that cannot be written when a tool ends costs no output: the entry is kept beside it,
# and is entered later.
command -v python3 >/dev/null || skip "needs python3"
printf 'hello' >in.txt

# start OUTPUT: a run that has its row and continues while a file `hold` exists
start() {
  touch hold
  frame-probe in.txt -o "$1" --mode hold --db r.sqlite 2>err &
  process=$!
  n=0
  until talus-runs list --db r.sqlite 2>/dev/null | grep -q running; do
    n=$((n + 1))
    [ $n -lt 200 ] || fail "the run has no row"
    sleep 0.05
  done
}
ended() {
  wait "$process" || fail "exit code $? where only the registry failed: $(cat err)"
  [ "$(cat "$1")" = hello ] || fail "no $1"
  says "its entry is in r.sqlite.late-"
  says "hint: talus-runs --db r.sqlite adopt"
}
n_rows() {
  expect 0 talus-runs list --db r.sqlite
  [ "$(grep -c frame-probe out)" -eq "$1" ] || fail "not $1 rows: $(cat out)"
  if grep -q running out; then fail "a run seems to go on: $(cat out)"; fi
}

# it is not a registry any more
start one.txt
rm -f r.sqlite r.sqlite-*
echo 'not a database, and longer than the header of one: ................................................' >r.sqlite
rm hold
ended one.txt
expect 1 talus-runs --db r.sqlite adopt
says "r.sqlite"
ls r.sqlite.late-* >/dev/null || fail "an entry that could not be entered is gone"
rm r.sqlite
expect 0 talus-runs --db r.sqlite adopt
prints "1 run entered in r.sqlite"
n_rows 1
[ -z "$(ls | grep late)" ] || fail "left: $(ls | grep late)"
expect 0 talus-runs trace one.txt --db r.sqlite
prints "by run 1: frame-probe in.txt -o one.txt"
expect 0 talus-runs show 1 --db r.sqlite
prints "a warning"

# somebody holds it for longer than a tool waits
export TALUS_REGISTRY_WAIT_S=2
start two.txt
cat >lock.py <<'END'
import os, sqlite3, time
registry = sqlite3.connect('r.sqlite', isolation_level=None)
registry.execute('BEGIN IMMEDIATE')
open('locked', 'w').close()
while os.path.exists('locked'): time.sleep(0.05)
END
python3 lock.py &
while [ ! -e locked ]; do sleep 0.05; done
rm hold
ended two.txt
says "database is locked"
expect 0 frame-probe in.txt -o three.txt --db r.sqlite
says "the run is recorded when it has ended"
rm locked
wait
expect 0 talus-runs --db r.sqlite adopt
prints "2 runs entered in r.sqlite"
n_rows 3

expect 1 talus-runs --db r.sqlite adopt r.sqlite
says "is the registry itself"
[ -s r.sqlite ] || fail "the registry is gone"

# the time to wait must be one
for wait in two -1 1e9; do
  TALUS_REGISTRY_WAIT_S=$wait expect 1 talus-runs list --db r.sqlite
  says "TALUS_REGISTRY_WAIT_S"
done
