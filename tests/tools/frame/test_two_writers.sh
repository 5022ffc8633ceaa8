# Two processes share one registry: no row is lost, nobody is turned away.
printf 'hello' >in.txt
many() {
  for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    frame-probe in.txt -o "out_$1_$i.txt" --db shared.sqlite -q 2>>"err_$1" || echo failed >>"failed_$1"
  done
}
many a &
many b &
wait
[ ! -e failed_a ] && [ ! -e failed_b ] || fail "a run was turned away: $(cat err_a err_b)"
expect 0 talus-runs list --db shared.sqlite
n=$(grep -c ' done ' out)
[ "$n" -eq 40 ] || fail "$n rows of 40"
