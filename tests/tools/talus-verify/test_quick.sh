# The quick study: the files complete, names checked. Verify/EachCase holds that every case is within
# its bound.
expect 0 talus-verify --list
prints "slide_20: "
prints "slide39: "

expect 0 talus-verify slide_20 bounce_face oblique stack_10 slide39 -o v --no-db
prints '| `bounce_face` |'
grep -q "on the Pareto front of both laws in" v/verification.md || fail "nothing said of the front"
prints "v/verification.md"
grep -A 1 '^Reference, the shortest steps extrapolated to none:$' v/verification.md | grep -q '^centre ' || fail "no reference of the slide"
grep -q '^| \[`oblique`\](oblique.svg) |' v/verification.md || fail "no diagram on the page"
n=$(head -1 v/verify.csv | tr ',' '\n' | wc -l)
[ "$n" -eq 19 ] || fail "verify.csv has $n columns"
for law in talus paper; do
  grep -q "^slide_20,$law," v/verify.csv || fail "slide_20 was not run with law $law"
done
for law in talus paper; do
  grep -q "^slide39_centre,$law,234," v/verify.csv || fail "the slide has no 39 x 6 unknowns with law $law"
  grep -q "^stack_10,$law,60," v/verify.csv || fail "stack_10 was not run with law $law"
done
grep -q '^| \[`bounce_face`\].* | [0-9.]* | `LawTalus' v/verification.md || fail "no claim of bounce_face"
grep -q "Pareto front" v/oblique.svg || fail "no front in oblique.svg"
[ "$(grep -c '</svg>' v/*.svg | grep -vc ':1$')" -eq 0 ] || fail "a diagram is not whole"
nothing_left

expect 0 talus-verify parabola -o one --no-db --json
prints '"holds": true'
[ "$(cut -d, -f1 one/verify.csv | sort -u | wc -l)" -eq 2 ] || fail "more than the case asked for"

expect 0 talus-verify parabola --leaving-out -o left --no-db
grep -q '^| sleep | stack of ten at rest' left/verification.md || fail "nothing said of sleep"
! grep -q 'does not hold' left/verification.md || fail "leaving out changes an answer"

# the page elsewhere finds its diagrams; parts that were not run are not on it
mkdir pages
expect 0 talus-verify parabola -o pages/of/diagrams --page pages/page.md --no-db
grep -q '(of/diagrams/parabola.svg)' pages/page.md || fail "the page does not find its diagrams"
! grep -q "Stability chart\|Leaving out\|The slide of" pages/page.md || fail "parts that were not run"
[ ! -e pages/of/diagrams/verification.md ] || fail "two pages"

expect 2 talus-verify parabel -o two --no-db
says "did you mean parabola?"
expect 2 talus-verify parabola --no-db
says "give -o DIR"
expect 1 talus-verify oblique -o three --peers nowhere --no-db
says "nowhere/oblique.csv"
expect 2 talus-verify --quick -o four --no-db
says "hint: --quick is gone"
exit 0
