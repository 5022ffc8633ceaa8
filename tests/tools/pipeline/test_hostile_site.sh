# A site file from elsewhere cannot make the pipeline run a command: text that make or the shell
# would take for one is quoted or refused.
. "$source_dir/tests/tools/pipeline/common.sh"
# refused SECTION KEY VALUE: talus-site ends with 1 and names the cause; nothing was run
refused() {
  site evil
  printf '[site]\nname = "a"\ncrs = "EPSG:32633"\n[%s]\n%s = %s\n' "$1" "$2" "$3" >evil/site.toml
  expect 1 talus-site evil/site.toml -o evil/stages --no-db
  says "$4"
  nothing_left evil/stages/site.mk evil/hurt
  rm -rf evil
}
refused terrain contours '"a;touch hurt.gpkg"' "cannot stand in a makefile"
refused terrain contours '"$(shell touch hurt)"' "cannot stand in a makefile"
refused terrain contours '"contours.gpkg|layername=a\nall: ; touch hurt"' "line break or control character"
refused 'hazard.class."x;touch hurt"' frequency_per_a 0.01 "cannot stand in a makefile"
refused 'hazard.class."$(shell touch hurt)"' frequency_per_a 0.01 "cannot stand in a makefile"
refused 'variant."x;touch hurt"' cost 1 "cannot stand in a makefile"
refused 'variant."x=y"' cost 1 "use letters, digits and _-+,."
refused 'fence."x\u001b[2J"' line '[[0, 0], [1, 1]]' 'the name x\x1b[2J'

# a key of parts without end overflows no stack, neither in the file nor on the command line
awk 'BEGIN { print "[output]"; for (i = 0; i < 60000; i++) printf "a."; print "a = 1" }' >deep.toml
expect 1 talus-site deep.toml -o stages --no-db
says "deep.toml:2: a key of 60001 parts, expected one or two"
awk 'BEGIN { print "[output]"; printf "x = {"; for (i = 0; i < 60000; i++) printf "\"=\"."; print "a = 1}" }' >deep.toml
expect 1 talus-site deep.toml -o stages --no-db
says "a key of 60001 parts"
printf '[site] # %s\nname = "%s"\n' "$(head -c 3000 /dev/zero | tr '\0' .)" "$(head -c 3000 /dev/zero | tr '\0' .)" >dots.toml
expect 0 talus-site dots.toml -o dots --no-db

# a name and a layer may hold any characters, and files blanks and letters of any alphabet
site odd
mv odd/contours.gpkg "odd/Höhen linien #1.gpkg"
sed -i -e "s/^name = .*/name = \"\$(shell touch hurt)'\"/" -e 's/^contours = .*/contours = "Höhen linien #1.gpkg"/' odd/site.toml
made odd terrain
[ -s odd/out/trn.tif ] || fail "no terrain"
printf '[terrain]\ncontours = "odd/Höhen linien #1.gpkg|layername=$(shell touch hurt)'"'"';touch hurt"\n' >layer.toml
expect 0 talus-site layer.toml -o stages --no-db
printf 'include stages/site.mk\nall: ; @echo $(SITE_CONTOURS)\n' >Makefile
expect 0 make
expect 1 talus-import layer.toml -o inputs.gpkg --no-db
says 'there is no layer "$(shell touch hurt)'
nothing_left hurt odd/hurt

# a fence is named as its user likes, and its runs without fences are made
site fences
sed -i '/^\[fence/,$d' fences/site.toml
y=5200100
for name in 'x;touch hurt' '$(shell touch hurt)' 'a=b' 'road #2, 50 %' "it's" 'a.b' 'C:\\\\x' '`touch hurt`'; do
  y=$((y + 5))
  printf '[fence."%s"]\nline = [[500060, %s], [500164, %s]]\nheight_m = 3\n' "$name" $y $y >>fences/site.toml
done
made fences WITHOUT=yes runs
talus-runs --db fences/out/runs.sqlite list | grep 'talus-dda .*without/run_1.h5' >command
[ "$(grep -o 'active=false' command | wc -l)" -eq 8 ] || fail "not all fences were taken away: $(cat command)"
nothing_left hurt fences/hurt

# names that begin as an option or as a remark of the shell do, and the sign of a pattern
for name in -c.gpkg '#1.gpkg' 'steep 30%.gpkg'; do
  site odd
  mv odd/contours.gpkg "odd/$name"
  sed -i "s/^contours = .*/contours = \"$name\"/" odd/site.toml
  rm -rf odd/out
  made odd terrain
  [ -s odd/out/trn.tif ] || fail "no terrain from $name"
  made odd -n terrain
  if grep -q '^talus-' out; then fail "nothing changed, and make would start a tool for $name"; fi
  rm "odd/$name"
done

# two objects of one file name are refused before anything runs
site twins
for name in Müller Möller; do
  printf '[object."%s"]\nposition_m = [[500100, 5200100]]\nradius_m = 2\n' $name >>twins/site.toml
done
expect 1 talus-site twins/site.toml -o twins/stages --no-db
says "object.Möller: has the same raster as object Müller"
nothing_left twins/stages/site.mk
