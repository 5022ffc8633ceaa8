# Work in progress is in a folder that nobody else can write into: links that other users have laid
# under names that a tool may take are not followed, and files of a killed tool are removed.
host=$(uname -n)
printf hello >in.txt
echo precious >mine
command -v python3 >/dev/null || skip "needs python3"
# links under the names of the next processes, as earlier versions took them
laid() {
  python3 - "$host" <<'END'
import os, sys
here = os.getpid()
for name in (".out", ".two"):
    for i in range(here + 1, here + 1500):
        os.symlink("mine", "%s.part-%s-%d.txt" % (name, sys.argv[1], i))
END
}
laid
expect 0 frame-probe in.txt -o out.txt --second two.txt --no-db
[ "$(cat mine)" = precious ] || fail "a link was followed: $(cat mine)"
[ ! -L out.txt ] && [ ! -L two.txt ] && cmp in.txt out.txt || fail "an output is a link"
find . -name '.*.part-*' -delete
# an output that is a link is replaced, not its target
ln -s mine led.txt
expect 0 frame-probe in.txt -o led.txt --overwrite --no-db
[ "$(cat mine)" = precious ] && [ ! -L led.txt ] || fail "an output was written through a link"

# the folder is closed to other users
(umask 002 && exec frame-probe in.txt -o shared.txt --mode wait --no-db) 2>/dev/null &
process=$!
n=0
until [ -n "$(find . -path './.shared.part-*/shared.txt')" ] || [ $n -eq 200 ]; do
  n=$((n + 1)) && sleep 0.05
done
hidden=$(find . -maxdepth 1 -name ".shared.part-$host-$process-*")
[ "$(stat -c %a "$hidden")" = 700 ] || fail "$hidden may be entered by others: $(stat -c %a "$hidden")"
kill -KILL $process
wait $process || true
[ -d "$hidden" ] || fail "a killed tool leaves what it had"
# the next one with this output takes it away, and leaves those of other hosts and of other outputs
mkdir .shared.part-elsewhere-1-abcdef .other.part-$host-$process-abcdef
expect 0 frame-probe in.txt -o shared.txt --no-db
[ ! -e "$hidden" ] && [ -d .shared.part-elsewhere-1-abcdef ] && [ -d .other.part-$host-$process-abcdef ] ||
  fail "leftovers: $(find . -name '.*.part-*')"
rmdir .shared.part-elsewhere-1-abcdef .other.part-$host-$process-abcdef
nothing_left
