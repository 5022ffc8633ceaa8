# Reading a registry needs no right to write: another user's, in a closed folder, with the rest of a
# killed process in its journal. And the members of a group may write a registry that one of them
# made.
command -v python3 >/dev/null || skip "needs python3"
printf 'hello' >in.txt
mkdir kept 'left ?#over'
expect 0 frame-probe in.txt -o first.txt --db kept/r.sqlite
cat >kill.py <<'END_OF_PYTHON'
import shutil, sqlite3
registry = sqlite3.connect('kept/r.sqlite', isolation_level=None)
registry.execute("PRAGMA wal_autocheckpoint = 0")
registry.execute("UPDATE run SET host = 'elsewhere'")
for end in ('', '-wal'):  # as a process leaves them that is killed now
    shutil.copy('kept/r.sqlite' + end, 'left ?#over/r.sqlite' + end)
registry.execute("UPDATE run SET host = 'here'")
END_OF_PYTHON
python3 kill.py
[ -s 'left ?#over/r.sqlite-wal' ] || fail "no journal"
rm -f kept/r.sqlite-wal kept/r.sqlite-shm
chmod a+rx . kept 'left ?#over'
chmod a+r kept/* 'left ?#over'/*
if [ "$(id -u)" = 0 ]; then
  command -v setpriv >/dev/null || skip "needs setpriv as root"
  setpriv --reuid=65534 --regid=65534 --clear-groups test -x "$(command -v talus-runs)" -a -r kept/r.sqlite || skip "the tests' folder is closed to others"
  other() { expect 0 setpriv --reuid=65534 --regid=65534 --clear-groups "$@"; }
else
  other() { expect 0 "$@"; }
fi
chmod a-w kept kept/* 'left ?#over' 'left ?#over'/*
for of in list 'list --summary' 'show 1' "trace $PWD/first.txt"; do
  # shellcheck disable=SC2086  # words
  other "$(command -v talus-runs)" --db kept/r.sqlite $of
done
prints 'by run 1: frame-probe in.txt -o first.txt'
other "$(command -v talus-runs)" --db 'left ?#over/r.sqlite' list --json
prints '"host": "elsewhere"'
[ "$(ls 'left ?#over')" = "$(printf 'r.sqlite\nr.sqlite-wal')" ] && [ "$(ls kept)" = r.sqlite ] || fail "a reader left: $(ls kept 'left ?#over')"
chmod u+w kept kept/* 'left ?#over' 'left ?#over'/*

# the group's, like everything else that a tool writes
mkdir office
(umask 002 && frame-probe in.txt -o office/out.txt >out 2>err) || fail "$(cat err)"
[ "$(stat -c %a office/runs.sqlite)" = 664 ] || fail "the registry has rights $(stat -c %a office/runs.sqlite)"
(umask 077 && frame-probe in.txt -o office/own.txt --db office/own.sqlite >out 2>err) || fail "$(cat err)"
[ "$(stat -c %a office/own.sqlite)" = 600 ] || fail "own.sqlite has rights $(stat -c %a office/own.sqlite)"
