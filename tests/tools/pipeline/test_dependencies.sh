# A stage is repeated when its inputs have changed, and only then.
. "$source_dir/tests/tools/pipeline/common.sh"
# Every section is read by a stage; where stages read single keys, none is forgotten. The rest of
# [site] is in the report alone.
reference=$source_dir/docs/reference/site-file.md stages=$source_dir/libcore/site/stages.cpp
for section in $(sed -n 's/^### \[\([a-z_]*\).*/\1/p' "$reference" | sort -u); do
  if grep -q "[{ ]\"$section\"" "$stages" || [ "$section" = site ]; then continue; fi
  for key in $(sed -n "/^### \[$section\]/,/^### /s/^| \(\`[^|]*\`\) |.*/\1/p" "$reference" | tr -d '`,'); do
    grep -q "\"$section.$key\"" "$stages" || fail "no stage of talus-site reads $section.$key"
  done
done

site slope
made slope -j2

# would GOAL...: the tools that make would start now
would() {
  made slope -n "$@"
  tools=$(sed -n 's/^talus-\([a-z]*\) .*/\1/p' out | sort | uniq -c | awk '{ printf "%s%s*%d", sep, $2, $1; sep = " " }')
}
would_be() { [ "$tools" = "$1" ] || fail "$2: make would start: $tools, expected $1"; }

echo '# a remark' >>slope/site.toml
would
would_be "report*1" "a comment in the site file"

sed -i 's/^height_m = 8/height_m = 7/' slope/site.toml
would
would_be "batch*2 check*1 fence*1 maps*1 report*1 runout*1" "another fence"
sed -i 's/^height_m = 7/height_m = 8/' slope/site.toml
would
would_be "report*1" "a fence that was moved and put back, and a comment"
made slope

printf '[fragmentation]\nenabled = true\n' >>slope/site.toml
would
would_be "batch*2 check*1 fence*1 maps*1 report*1 runout*1" "blocks that break"
sed -i '/^\[fragmentation\]$/,$d' slope/site.toml
would
would_be "" "blocks that break no longer"

would RUNS=3
would_be "batch*2 fence*1 maps*1 report*1 runout*1" "two more seeds"
variants slope '[variant.low]\nweight = 1\nground.slope.friction_deg = 20\n[variant.high]\nweight = 1'
would RUNS=2
would_be "batch*2 fence*3 maps*3 report*1 runout*1" "two cases of two seeds"
sed -i '/^\[variant/,$d' slope/site.toml
would
would_be "" "nothing changed"

would FENCE_FLAGS='--code onr'
would_be "fence*1 report*1" "another design code"
would
would_be "" "a dry run remembers no options"
made slope -j2 V=1 FENCE_FLAGS='--code onr'
prints "talus-fence site.toml"
if grep -q talus-maps out; then fail "another design code made the maps again"; fi
made slope

sed -i 's/^plane_dip_deg = 33/plane_dip_deg = 32/' slope/site.toml
would
would_be "batch*2 blocks*1 check*1 fence*1 maps*1 report*1 runout*1" "another failure plane"
sed -i 's/^plane_dip_deg = 32/plane_dip_deg = 33/' slope/site.toml

touch slope/contours.gpkg
would
would_be "" "the same contours with another time"
cp "$source_dir/sample_sites/maungawhau/contours.gpkg" slope/contours.gpkg
would
would_be "batch*2 blocks*1 check*1 fence*1 import*1 maps*1 report*1 runout*1 tin*1 trn*1" "other contours"
cp "$source_dir/sample_sites/designed/contours.gpkg" slope/contours.gpkg

sed -i 's/^friction_deg = 25/friction_deg = 250/' slope/site.toml
code=0
make -C slope BIN= >out 2>err || code=$?
[ $code -eq 2 ] || fail "make ended with $code for a site file that cannot be used"
says "friction_deg is 250"
says "hint: give degrees"
