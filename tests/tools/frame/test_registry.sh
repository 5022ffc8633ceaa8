# Runs, their inputs and outcomes are in the registry; and odd names do no harm.
printf 'hello' >"it's a \"file\" ü.txt"
expect 0 frame-probe "it's a \"file\" ü.txt" -o out.txt --factor-m 2 --json
id=$(sed -n 's/.*"run_id": "\(.*\)".*/\1/p' out)
[ "${#id}" -eq 16 ] || fail "no run id in: $(cat out)"
expect 3 frame-probe out.txt -o two.txt --mode fail
expect 0 frame-probe out.txt -o two.txt

expect 0 talus-runs list
prints "$id"
prints failed
expect 0 talus-runs show 1 --json
prints '"sha256": "2cf24dba5fb0a30e26e83b2ac5b9e29e1b161e5c1fa7425e73043362938b9824"'
prints '"text": "a warning"'
expect 0 talus-runs show "$id"
prints "param        factor-m = 2  (cli)"
prints "param        mode = copy  (default)"
expect 0 talus-runs trace two.txt
prints "by run 3: frame-probe out.txt -o two.txt"
prints "it's a"
expect 0 talus-runs trace two.txt --prov
prints '"talus:run/3": {'
prints '"prov:entity": "talus:file/2cf24dba5fb0a30e26e83b2ac5b9e29e1b161e5c1fa7425e73043362938b9824"'
mkdir -p away && cd away
expect 0 talus-runs trace ../two.txt
prints "by run 3: frame-probe out.txt -o two.txt"
cd ..
expect 1 talus-runs trace err
says "runs.sqlite wrote a file with this content"
expect 1 talus-runs show 99
expect 1 talus-runs list --db absent.sqlite
printf 'not a database' >broken.sqlite
expect 1 talus-runs list --db broken.sqlite
says "broken.sqlite"
expect 1 frame-probe out.txt -o three.txt --db broken.sqlite
says "hint: move it away, name another registry with --db, or run with --no-db"
nothing_left three.txt broken.sqlite.late-*

# The id depends on content and options, not on names or on how often it was run.
mkdir elsewhere
cp "it's a \"file\" ü.txt" elsewhere/plain.txt
expect 0 frame-probe elsewhere/plain.txt -o elsewhere/out.txt --factor-m 2 --json --no-db
prints "$id"
[ ! -e elsewhere/runs.sqlite ] || fail "--no-db wrote a registry"
expect 0 frame-probe elsewhere/plain.txt -o elsewhere/out.txt --factor-m 3 --json --overwrite
if grep -q "$id" out; then fail "the id does not depend on the options"; fi

# SQLite's name for a database without a file is none for a registry
expect 2 frame-probe out.txt -o three.txt --db :memory:
says "--db: is :memory:, which SQLite takes for no file"
nothing_left three.txt
