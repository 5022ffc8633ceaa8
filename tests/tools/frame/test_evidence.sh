# Pages of the evidence agree with its files: a changed value, a changed page and files of two
# commits are found.
command -v python3 >/dev/null || skip "needs python3"
evidence() { python3 "$source_dir/tests/studies/evidence.py" check --evidence evidence; }
anew() {
  rm -rf evidence
  mkdir -p evidence/data
  cat >evidence/page.md.in <<'END_OF_PAGE'
# Page
{{commits}}

The rock goes {{one.all/a/run-out}} m ({{interval one.all/a/run-out}}), all of them {{one.all/*/run-out}}; below 9 m
{{holds one.all/*/run-out < 9}}, below 12 m it {{holds one.all/*/run-out < 12}}. Made by {{made two}}.

{{table one.all | rock}}
END_OF_PAGE
  for name in one two; do
    printf '# command: sh tests/run.sh\n# commit: 0123456789\n# date: 2026-11-30\ntable,row,quantity,value,low,high,unit\n'
    printf 'all,a,run-out,8,7,9,m\nall,b,run-out,10,,,m\n'
  done | awk '/^# command/ { n++ } { print > "evidence/data/" (n == 1 ? "one" : "two") ".csv" }'
  cat >evidence/page.md <<'END_OF_PAGE'
# Page
All numbers are of commit 01234567.

The rock goes 8 m (7 to 9), all of them 8 to 10; below 9 m **does not hold**, below 12 m it holds.
Made by `sh tests/run.sh` (01234567, 2026-11-30).

| rock | run-out [m] |
|---|---|
| a | 8 (7 to 9) |
| b | 10 |
END_OF_PAGE
}
anew
expect 0 evidence
sed -i 's/^all,b,run-out,10/all,b,run-out,11/' evidence/data/one.csv
expect 1 evidence
prints "page.md is not what docs/evidence/data says"
anew
sed -i 's/commit: 0123456789/commit: abcdef0123/' evidence/data/two.csv
expect 1 evidence
prints "files of several commits make no page"
# an older file is let through, and the page says so
sed -i 's/^# date/# old: to be measured again\n# date/' evidence/data/two.csv
expect 1 evidence
prints "page.md is not what docs/evidence/data says"
sed -i -e 's/^All numbers.*/All numbers are of commit 01234567, but for older ones that wait to be measured again: two\n(abcdef01)./' \
  -e 's/(01234567, 2026-11-30)/(abcdef01, 2026-11-30; older, to be measured again)/' evidence/page.md
expect 0 evidence
cp evidence/data/one.csv evidence/data/three.csv
expect 1 evidence
prints "three.csv is on no page"
anew
sed -i 's/run.sh/gone.sh/' evidence/data/two.csv evidence/page.md
expect 1 evidence
prints "its command is gone"
