# A registry of another user, or in a folder without rights, costs no output: the entry is kept
# beside it where it may, else it is said to be lost.
printf 'hello' >in.txt
mkdir kept
expect 0 frame-probe in.txt -o first.txt --db kept/r.sqlite
chmod 644 kept/r.sqlite
chmod 755 kept .
mkdir mine
chmod 777 mine
# other WORDS...: as somebody who may read the registry and not write it
if [ "$(id -u)" = 0 ]; then
  command -v setpriv >/dev/null || skip "needs setpriv as root"
  setpriv --reuid=65534 --regid=65534 --clear-groups test -x "$(command -v frame-probe)" -a -w mine || skip "the tests' folder is closed to others"
  other() { expect 0 setpriv --reuid=65534 --regid=65534 --clear-groups "$@"; }
else
  chmod a-w kept/r.sqlite kept
  other() { expect 0 "$@"; }
fi
other "$(command -v frame-probe)" in.txt -o mine/second.txt --db kept/r.sqlite
chmod u+w kept kept/r.sqlite
[ "$(cat mine/second.txt)" = hello ] || fail "no output"
says "the run registry cannot be used"
says "its entry is lost"

# a folder that is not there is a misspelt name: refused before any work
expect 1 frame-probe in.txt -o third.txt --db nowhere/r.sqlite
[ ! -e third.txt ] || fail "an output where the registry is refused"
