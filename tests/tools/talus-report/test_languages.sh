# --texts de, fr, it: the page says nothing in English: no text of the shipped words, no words of
# verdicts, limits, plan and fields, and numbers have the language's signs.
command -v python3 >/dev/null || skip "needs python3"
run-probe . 3 objects=watched still_runs=1
mkdir -p results/runs results/without
mv run_*.h5 results/runs/
cp slope.tif results/trn.tif
expect 0 talus-runout results/runs/*.h5 --trn results/trn.tif -o results/runout.gpkg --json results/runout.json --tables results --no-db
expect 0 talus-maps results/runs/*.h5 --trn results/trn.tif -o results/maps --pages png --no-db
printf '\n[hazard.class.all]\nfrequency_per_a = 0.01\n' >>site.toml
expect 0 talus-hazard site.toml results/runs/*.h5 --trn results/trn.tif -o results/hazard --json results/hazard.json --pages png --no-db
expect 0 talus-trace site.toml results/runs/*.h5 --trn results/trn.tif -o results/trace.gpkg --json results/trace.json --no-db
if grep -q '^\[fence\.' site.toml; then
  expect 0 talus-fence site.toml results/runs/*.h5 --trn results/trn.tif -o results/fence.gpkg --json results/fence.json --no-db
fi
cat >words.py <<'END'
# words.py PAGE: the words of a page that a reader sees, a line each place
import html, re, sys
page = open(sys.argv[1], encoding="utf-8").read()
page = re.sub(r"<(style|script)[^>]*>.*?</\1>", "\n", page, flags=re.S)
page = re.sub(r"<code>.*?</code>", " ", page, flags=re.S)  # keys, commands and files
seen = re.findall(r'aria-label="([^"]*)"|alt="([^"]*)"', page)
page = html.unescape("\n".join(a + b for a, b in seen) + re.sub(r"<[^>]*>", "\n", page))
for line in page.splitlines():
    if line.strip():
        print(line.strip())
END
english='the|of|is|are|were|and|with|by|which|that|has|runs|needs|from|above'
for language in de fr it; do
  expect 0 talus-report site.toml --dir results -o $language.html --texts $language --no-db
  [ ! -s err ] || fail "$language: $(cat err)"
  grep -q "<html lang=\"$language\">" $language.html || fail "$language: the page is of another language"
  python3 words.py $language.html >$language.txt
  if grep -wiE "$english" $language.txt >left.txt; then
    fail "$language: $(head -n 5 left.txt)"
  fi
  grep -qE '[0-9],[0-9]' $language.txt || fail "$language: no decimal comma"
done
expect 1 talus-report site.toml --dir results -o xx.html --texts xx --no-db
says 'xx: '
