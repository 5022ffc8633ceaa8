# Registries of shards become one: no run twice, ancestry across them, and nothing where two differ.
command -v sqlite3 >/dev/null || skip "needs sqlite3"
printf 'hello' >in.txt
expect 0 frame-probe in.txt -o one.txt --db a.sqlite
expect 0 frame-probe one.txt -o two.txt --db b.sqlite --factor-m 2
expect 1 frame-probe in.txt -o no.txt --db b.sqlite --mode refuse

expect 0 talus-runs merge a.sqlite b.sqlite -o all.sqlite
prints "all.sqlite: 3 runs added, 0 completed, 0 were there"
expect 0 talus-runs merge a.sqlite b.sqlite -o all.sqlite --json
prints '"n_known": 3'
expect 0 talus-runs trace two.txt --db all.sqlite
prints "in.txt"
expect 0 talus-runs list --summary --db all.sqlite
grep -q '^frame-probe  *2  *1  *0  *0 ' out || fail "the summary: $(cat out)"
grep -q '^all  *2  *1  *0  *0 ' out || fail "the summary: $(cat out)"

# one entry was changed
cp b.sqlite other.sqlite
sqlite3 other.sqlite "UPDATE run SET exit_code = 3 WHERE status = 'failed'"
expect 0 frame-probe in.txt -o three.txt --db c.sqlite
cp all.sqlite before.sqlite
expect 1 talus-runs merge c.sqlite other.sqlite -o all.sqlite
says "other.sqlite: run 2 (frame-probe on "
says "is not as it stands in all.sqlite"
says "nothing was merged"
expect 0 talus-runs list --db all.sqlite --json
[ "$(grep -c '"command_line"' out)" -eq 3 ] || fail "something was merged"

expect 1 talus-runs merge all.sqlite -o all.sqlite
says "is the registry that is written to itself"
expect 1 talus-runs merge absent.sqlite -o all.sqlite
says "absent.sqlite: there is no such registry"
expect 1 talus-runs merge in.txt -o all.sqlite
expect 2 talus-runs merge a.sqlite
