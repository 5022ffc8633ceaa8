# The effective settings and their sources can be shown without running anything.
printf 'hello' >in.txt
expect 0 frame-probe in.txt -o out.txt --factor-m 2.5 --print-config
prints "factor-m = 2.5  # cli"
prints 'mode = "copy"  # default'
[ ! -e out.txt ] || fail "--print-config ran the tool"
expect 0 frame-probe --help
grep -q -e '--factor-m FLOAT *=*\[*0\.5' out || fail "no default in the help: $(grep factor-m out)"
expect 0 frame-probe --version
prints "frame-probe 0."
