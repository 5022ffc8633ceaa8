# Every kind of end gives its exit code, its words, and either whole outputs or none.
printf 'hello' >in.txt

expect 0 frame-probe in.txt -o out.txt --second two.txt
prints copied
says "frame-probe: warning: a warning"
cmp -s in.txt out.txt && cmp -s in.txt two.txt || fail "the copies differ"
nothing_left

expect 1 frame-probe in.txt -o out.txt
says "out.txt: exists already"
says "hint: give --overwrite to replace it"
expect 0 frame-probe in.txt -o out.txt --overwrite
expect 0 frame-probe in.txt -o out.txt -overwrite -q
[ ! -s out ] || fail "-q prints"

expect 1 frame-probe absent.txt -o new.txt
says "frame-probe: absent.txt: there is no such file"
expect 2 frame-probe in.txt -o in.txt --overwrite
says "is both an input and an output"
expect 2 frame-probe in.txt -o new.txt --second new.txt
says "is named for two outputs"
expect 2 frame-probe in.txt -o new.txt --db new.txt
says "is named for an output and for the run registry"
expect 2 frame-probe in.txt -o ""
says "the name is empty"
frame-probe in.txt -o /dev/stdout 2>err | cat >piped
says "/dev/stdout: is not a regular file"
[ ! -s piped ] || fail "something was written into a pipe"
expect 1 frame-probe in.txt -o no/such/folder/new.txt
says "there is no such folder"
expect 1 frame-probe in.txt -o new.txt --mode refuse
says "frame-probe: in.txt:3: found a, expected b"
says "  hint: write b"
expect 3 frame-probe in.txt -o new.txt --mode fail
says "the energy grew"
expect 1 frame-probe in.txt -o new.txt --mode throw
says "unexpected: a surprise"
expect 2 frame-probe in.txt
expect 2 frame-probe in.txt -o new.txt --factor-m metres
expect 2 frame-probe in.txt -o new.txt --colour red
nothing_left new.txt

# A broken limit of the run's health: the file is kept, the code says so.
expect 3 frame-probe in.txt -o kept.txt --mode check
says "health: largest_penetration_m is 2, limit 1"
[ -s kept.txt ] || fail "the output of a run with a broken limit must be kept"

# Runs side by side are told apart.
expect 3 frame-probe in.txt -o kept.txt --overwrite --mode check --label run_7
says "run_7: frame-probe: health: largest_penetration_m"
says "run_7: frame-probe: warning: a warning"
prints "run_7: copied"
# names that leave no room for work in progress are refused before it
long=$(printf 'x%.0s' $(seq 161))
expect 1 frame-probe in.txt -o "$long"
says 'the name has 161 bytes, expected at most 160'
# a folder or file whose name cannot be is said as such
ln -s loop loop
expect 1 frame-probe loop -o new.txt
says 'loop'
grep -q unexpected err && fail 'a link to itself is an unexpected failure'
frame-probe in.txt -o one.txt --json --no-db --label a >labelled
frame-probe in.txt -o one.txt --json --no-db --overwrite >plain
cmp labelled plain || fail "a label makes another run of it"

# Interrupted: 130, nothing left.
frame-probe in.txt -o new.txt --mode wait 2>err &
process=$!
sleep 1
kill -INT "$process" 2>/dev/null || kill -TERM "$process"
code=0
wait "$process" || code=$?
case $code in 130) ;; *) kill -TERM "$process" 2>/dev/null; fail "an interrupt gave exit code $code" ;; esac
nothing_left new.txt
