# Standard output closed or full: the outputs are in place, and the exit code says that the result
# was not read. With standard error closed no message goes into a file that is being written.
printf 'hello' >in.txt
[ -e /dev/full ] || skip "needs /dev/full"
same() { cmp in.txt "$1" || fail "$1 is not what was to be written"; }

frame-probe in.txt -o full.txt --no-db >/dev/full 2>err && fail "a full standard output is no fault"
says "standard output: cannot be written"
same full.txt
frame-probe in.txt -o closed.txt --no-db 2>err >&- && fail "a closed standard output is no fault"
says "standard output: cannot be written"
same closed.txt
frame-probe in.txt -o quiet.txt --no-db -q 2>err >&- || fail "nothing was to be printed: $(cat err)"
same quiet.txt
frame-probe in.txt -o deaf.txt --db r.sqlite >out 2>&- <&- || fail "exit code $? with standard error closed"
same deaf.txt
expect 0 talus-runs list --db r.sqlite
prints done
frame-probe in.txt -o none.txt --db r.sqlite >&- 2>&- <&- && fail "a closed standard output is no fault"
same none.txt
expect 0 talus-runs list --db r.sqlite
[ "$(grep -c frame-probe out)" = 2 ] || fail "not two runs: $(cat out)"

# options that only print say so, too
for words in --help --version '--describe json' '-o none.txt --print-config'; do
  frame-probe in.txt $words >/dev/full 2>err && fail "$words: a full standard output is no fault"
  frame-probe in.txt $words >&- 2>err && fail "$words: a closed standard output is no fault"
  frame-probe in.txt $words >out 2>err || fail "$words: $(cat err)"
  [ -s out ] || fail "$words prints nothing"
done
