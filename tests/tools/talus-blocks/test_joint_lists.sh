# Joint lists as other programs write them give the same sets; compass azimuths are turned.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
awk 'BEGIN { srand(3); for (s = 0; s < 3; ++s) for (i = 0; i < 10; ++i) {
  d = (s == 0 ? 180 : s == 1 ? 12 : 95) + 4 * rand() - 2; q = (s == 0 ? 35 : s == 1 ? 80 : 84) + 4 * rand() - 2
  printf "%.1f %.1f\n", d, q } }' >plain.txt
awk 'BEGIN { print "Index;CenterX;CenterY;CenterZ;NormalX;NormalY;NormalZ;RMS;Dip dir.;Dip" }
  { print NR - 1 ";500020.1;5200020.2;140;0;0;1;0.01;" $1 ";" $2 }' plain.txt >facets.csv
awk 'BEGIN { printf "\357\273\277" } { gsub(/\./, ","); printf "%s;%s\r\n", $1, $2 }' plain.txt >excel.csv
awk 'BEGIN { print "* Dips\nID,Strike (Right),Dip,Quantity" } { s = $1 - 90; printf "%d,%.1f,%s,1\n", NR, (s < 0 ? s + 360 : s), $2 }' plain.txt >dips.csv
awk 'BEGIN { print "Trend\tPlunge" } { t = $1 + 180; printf "%.1f\t%.1f\n", (t >= 360 ? t - 360 : t), 90 - $2 }' plain.txt >stereonet.txt
awk 'BEGIN { print "% DS dipdir(\302\272) dip(\302\272) density" } { print 1, $1, $2, 0.4 }' plain.txt >dse.txt
awk 'BEGIN { print "dip dipdirection" } { print $2 " " $1 }' plain.txt >swapped.txt
sets() { # sets FILE [LINE...]: blocks of the file's sets
  list=$1
  shift
  sed '/^\[joints/,/^$/d' site.toml >listed.toml
  printf '\n[joints.m]\nmeasured_file = "%s"\nn_sets = 3\nspacing_m = 3\n' "$list" >>listed.toml
  for line in "$@"; do printf '%s\n' "$line" >>listed.toml; done
  expect 0 talus-blocks listed.toml --trn trn.tif -o blocks.h5 --no-db --overwrite --json
  python3 -c 'import json
for s in json.load(open("out"))["joints"]: print(s["name"], *("%.6f" % s[k] for k in ("dip_deg", "dip_direction_deg", "fisher_k")))' >"$list.sets"
}
make_site
sets plain.txt
says "plain.txt: 30 orientations from pairs of dip direction, dip"
for list in facets.csv excel.csv dips.csv stereonet.txt dse.txt swapped.txt; do
  sets $list
  cmp plain.txt.sets $list.sets || fail "$list gives other sets: $(cat $list.sets)"
done
sets facets.csv
says "from columns Dip dir., Dip (dip direction, dip); 8 other columns passed over"
sets dips.csv
says "columns Strike (Right), Dip, Quantity (strike, dip by the right-hand rule)"
sed 1d swapped.txt >bad.txt
printf '\n[joints.m]\nmeasured_file = "bad.txt"\nn_sets = 3\nspacing_m = 3\n' >joints
sed '/^\[joints/,/^$/d' site.toml | cat - joints >bad.toml
expect 1 talus-blocks bad.toml --trn trn.tif -o bad.h5 --no-db
says "look like dip, dip direction; expected dip direction, dip"
says "a first line names them: Dip direction and Dip"
nothing_left bad.h5

# 3.5 degrees of declination less 1 of convergence; of a point cloud's list none
awk '{ print $1 - 2.5, $2 }' plain.txt >compass.txt
sets compass.txt '[joints]' 'declination_deg = 3.5' 'convergence_deg = 1'
says "[joints]: azimuths turned by 2.5 degrees to the map's north (declination 3.5, convergence 1)"
paste -d ' ' plain.txt.sets compass.txt.sets | awk '{ d = $3 - $7; if (d * d > 1e-9 || $2 != $6) exit 1 }' ||
  fail "declination: $(cat compass.txt.sets)"
sets facets.csv '[joints]' 'declination_deg = 3.5'
cmp plain.txt.sets facets.csv.sets || fail "a compass turned what was computed from points"
says "computed from points, so no compass turns them"

# facets of a point cloud: 100,000 are few (seconds; with a mean for each of them it were minutes)
awk 'BEGIN { srand(1); for (i = 0; i < 100000; i++) printf "%.2f %.2f\n", (i % 2 ? 80 : 170) + 10 * rand(), 60 + 10 * rand() }' >many.txt
sed '/^\[joints/,/^$/d' site.toml >many.toml
printf '\n[joints.m]\nmeasured_file = "many.txt"\nn_sets = 2\nspacing_m = 20\nfisher_k = 0\n' >>many.toml
timeout 120 talus-blocks many.toml --trn trn.tif -o many.h5 --no-db --overwrite >out 2>err || fail "100,000 orientations: exit code $?: $(cat err)"
says "many.txt: 100000 orientations"
