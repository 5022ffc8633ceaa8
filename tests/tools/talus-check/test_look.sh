# A look before the run: volumes, moving blocks, rock in front of the mass, fences, time;
# implausible values are refused and shown.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site '[ground.rock]' 'friction_deg = 28' '[fence.low]' 'line = [[500010, 5200006], [500036, 5200006]]' \
  '[fence.high]' 'line = [[500010, 5200042], [500036, 5200042]]'

# cut OPTIONS...: blocks; look OPTIONS...: cut with the same, and looked at
cut() { blocks --trn-out bed.tif --overwrite -q "$@"; }
look() {
  cut "$@" || return
  talus-check site.toml --trn trn.tif --bed bed.tif --blocks blocks.h5 -o check.html --report check.json \
    --probe-s 1.5 --overwrite --no-db "$@"
}

# A hollow with a step at its foot: part of it is stable, and the look says where it leans.
expect 0 look
prints "of blocks, "
prints "will it move: "
prints "at the foot it leans on a step of up to"
says "source.failure_surface: the mass leans on a step of up to"
prints "fence low: 26 m long"
says "fence.high, x 500023, y 5200042: no fall line from the source comes to it"
prints "time: a run takes about"
for part in "Will it move?" 'class="plan"' 'class="chart"' '<title>step of ' "Blocks that hold others" \
  "stereonet" "fall lines that come to it"; do
  grep -qF "$part" check.html || fail "the page does not have: $part"
done
if grep -q 'The same at the source' check.html; then fail "a short slope has two sections"; fi
if grep -q '<script\|http://\|https://' check.html; then fail "the page asks for something"; fi
three="$(value check.json volume_of_blocks_m3) $(value check.json volume_of_prisms_m3) $(value check.json volume_at_nodes_m3)"
for volume in $three; do
  holds "($volume / $(value check.json volume_of_prisms_m3) - 1) ^ 2 < 0.03 ^ 2"
done
hollow=$(value check.json moved_share)
holds "$(value check.json duration_asked_for_s) >= 10"

# The same inputs give the same page; a run count is not part of it.
mv check.html first.html
expect 0 look
cmp -s check.html first.html || fail "another page"
expect 0 talus-check site.toml --trn trn.tif --bed bed.tif --blocks blocks.h5 -o check.html --probe-s 1.5 --overwrite --no-db --runs 40
cmp -s check.html first.html || fail "the count of runs changed the page"
prints "40 runs about"

# Doubts of the stages before are numbered, in words and on the map; every input lies over the
# terrain, also those outside.
cat >before.json <<'END'
{"layers": [{"name": "contours", "file": "map.gpkg", "magnitudes": {"x_m": {"lowest": 499950, "highest": 500080}, "y_m": {"lowest": 5199970, "highest": 5200080}}}],
 "doubts": [{"state": "accepted", "file": "map.gpkg", "what": "contour", "feature": 5, "expected": "1040 m", "hint": "mend it", "n": 3, "at": [[500020, 5200020, 0]]}]}
END
seen() {
  talus-check "$1" --trn trn.tif --bed bed.tif --blocks blocks.h5 -o check.html --report check.json --overwrite --no-db \
    --probe-s 0 --reports before.json --doubts doubts.gpkg
}
expect 0 seen site.toml
for part in '<b>1</b> <b>accepted:</b> map.gpkg: 3 contours, the first at 0 m, feature 5, x 500020, y 5200020: expected 1040 m' \
  'map of the inputs' '>contours</text>' '>fence.low</text>'; do
  grep -qF "$part" check.html || fail "the page does not have: $part"
done
! grep -q '1040 m' check.json || fail "the report repeats doubts of other stages"
[ "$(ogrinfo -so doubts.gpkg doubts | sed -n 's/Feature Count: //p')" = "$(grep -c '"state"' check.json)" ] ||
  fail "the layer has other doubts than the report"
# A site that cannot be looked at has a page that shows why, and where its inputs lie
{ cat site.toml; printf '[fence.off]\nline = [[500500, 5200006], [500536, 5200006]]\n'; } >off.toml
rm check.html
expect 1 seen off.toml
for part in 'map of the inputs' '>source</text>' '<b>refused:</b> off.toml'; do
  grep -qF "$part" check.html || fail "the page of a refused site does not have: $part"
done
says "off.toml"

# Objects are drawn and named, and so is a mass that could leave on a plane; one on the mass is
# doubted.
cat site.toml >bare.toml
cat >>site.toml <<'EOF'
[object.road]
line = [[500000, 5200008], [500050, 5200008]]
width_m = 4
[object.hut]
kind = "house"
polygon = [[500022, 5200030], [500026, 5200030], [500026, 5200034], [500022, 5200034]]
EOF
expect 0 look
prints "object road: "
prints "fall lines come to it"
says "object.hut, x 500024, y 5200032: it stands on the mass"
for part in '>road</text>' '>hut</text>' '<title>plane of ' '<td>house</td>'; do
  grep -qF "$part" check.html || fail "the page does not have: $part"
done
holds "$(value check.json outlined_m3) > 0"
mv bare.toml site.toml

# A plane that comes out at the foot: more goes, and nothing is in front of it.
expect 0 look --set source.failure_surface=daylighting
holds "$(value check.json moved_share) > $hollow"
holds "$(value check.json share_of_foot_with_a_step) < 0.2"

# The hollow without the part that leans on its foot.
expect 0 blocks --overwrite --set source.daylight=sliding --report blocks.json
says "can leave along sliding; the rest leans on the foot and is left out"
holds "$(value blocks.json leans_on_the_foot_m3) > 0"
holds "($(value blocks.json hollow_volume_m3) - $(value blocks.json leans_on_the_foot_m3)) / $(value blocks.json prism_volume_m3) - 1 < 1e-9"
expect 1 blocks --overwrite --set source.daylight=slide
says "there is no joint set slide; there are: sliding, rear, lateral"
expect 1 blocks --overwrite --set source.daylight='sliding + sliding'
says "are parallel"

# Friction above the dip: it is stable.
expect 0 look --set ground.rock.friction_deg=60 --set material.rock.friction_deg=60
prints "it stands"
says "this is not a rockslide"
if grep -q "ends after 3 s" out; then fail "a mass with a splinter that falls off ends early"; fi
expect 0 look --set ground.rock.friction_deg=60 --set material.rock.friction_deg=60 --set source.min_block_volume_m3=10
prints "a run in which nothing moves ends after 3 s"

# Without the engine
cut
expect 0 talus-check site.toml --trn trn.tif --bed bed.tif --blocks blocks.h5 --no-db --probe-s 0
prints "no probe of the engine was made"

# Implausible: 800 m for 8 m; the page is there and says so.
rm check.html
blocks --trn-out bed.tif --overwrite -q --set source.depth_m=800 --set joints.sliding.spacing_m=60 \
  --set joints.rear.spacing_m=60 --set joints.lateral.spacing_m=60 2>err || { cat err; fail "no blocks"; }
deep() {
  talus-check site.toml --trn trn.tif --bed bed.tif --blocks blocks.h5 -o check.html --overwrite --no-db --probe-s 0 \
    --set source.depth_m=800 "$@"
}
expect 1 deep
says "deep on average"
says "of the relief over it"
says "--accept-doubts goes on with it"
grep -q "refused:" check.html || fail "the page does not say what is refused"
expect 0 deep --accept-doubts
says "source.depth_m: the mass is"

# Faults that the engine would find late, and that talus-hazard would find after all runs
cp site.toml no_recipe.toml
printf '[hazard]\nrecipe = "switzerland_zh"\n' >>site.toml
expect 1 look
says 'recipe is "switzerland_zh", which is neither known nor a file'
sed -i 's/switzerland_zh/holes.toml/' site.toml
printf 'name = "holes"\n' >holes.toml
expect 1 look
says "holes.toml"
cp "$source_dir/share/hazard/switzerland_ti.toml" holes.toml
expect 0 look
sed -i 's/holes.toml/new_zealand_christchurch/' site.toml
expect 1 look
says 'is of risk, and the site'
mv no_recipe.toml site.toml
expect 1 look --set solver.duration_s=0.001
says "less than a time step"
expect 1 talus-check site.toml --trn trn.tif --bed trn.tif --blocks blocks.h5 --no-db
says "below the ground"
