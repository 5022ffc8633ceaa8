# A line that is cut (SIGHUP) ends a tool as SIGTERM does, also when it is told twice; one that was
# started to outlive its terminal continues.
printf 'hello' >in.txt
frame-probe in.txt -o new.txt --mode wait 2>err &
process=$!
sleep 1
kill -HUP "$process"
kill -HUP "$process" 2>/dev/null || true
code=0
wait "$process" || code=$?
[ $code -eq 130 ] || fail "a hang-up gave exit code $code"
says "interrupted"
nothing_left new.txt

touch hold
(trap '' HUP && exec frame-probe in.txt -o kept.txt --mode hold) &
process=$!
sleep 1
kill -HUP "$process"
rm hold
wait "$process" || fail "a hang-up that was to be ignored ended the tool"
[ -s kept.txt ] || fail "no output"
