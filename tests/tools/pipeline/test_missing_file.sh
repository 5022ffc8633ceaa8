# A file that the site file names and that is not there ends make at once, with the key's line; once it
# is there, make continues. Data of a manifest are looked for before.
. "$source_dir/tests/tools/pipeline/common.sh"
site slope
made slope terrain
cp slope/site.toml site.toml

# refused KEY: make ends without a signal
refused() {
  code=0
  timeout 60 make -C slope BIN= terrain >out 2>err || code=$?
  [ $code -eq 2 ] || fail "make ended with $code where $1 names a file that is missing"
  says "site.toml:$(grep -n "^$1 = " slope/site.toml | cut -d: -f1): $1 of [$2]: there is no file"
}
sed 's/^contours = .*/contours = "map.gpkg"/' site.toml >slope/site.toml
refused contours terrain
cp slope/contours.gpkg slope/map.gpkg
made slope terrain
rm slope/map.gpkg
refused contours terrain

sed 's/^line = .*/file = "fence.gpkg"/' site.toml >slope/site.toml
refused file fence.valley

cp site.toml slope/site.toml
rm -r slope/out
printf '%064d  %s\n' 0 data.gpkg >slope/manifest.sha256
code=0
make -C slope BIN= terrain >out 2>err || code=$?
[ $code -eq 2 ] || fail "make ended with $code without the data of its manifest"
says "The data of this site are missing or differ"
nothing_left slope/out/stages/site.mk slope/out/trn.tif
