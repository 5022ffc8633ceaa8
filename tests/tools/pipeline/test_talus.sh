# One command over the tools: the tools it starts, its lists, and its refusals.
. "$source_dir/tests/tools/pipeline/common.sh"
talus=${bin%%:*}/talus
expect 0 "$talus" help
prints "talus run"
for tool in "${bin%%:*}"/talus-*; do
  [ -f "$tool" ] && [ -x "$tool" ] || continue
  grep -q "^  ${tool##*/talus-}  *[A-Z]" out || fail "help does not list $tool"
done
expect 0 "$talus" help runs
prints "Usage: talus-runs"
expect 0 "$talus" help run
prints "runout: "
expect 0 "$talus" help new
prints "GROUND is an elevation model"
expect 0 "$talus" --version
prints "talus "
expect 2 "$talus" mapps
says "mapps is not a command: expected run, new, help or a tool"
expect 2 "$talus" run absent
says "has no site.toml: give the folder of a site"
expect 2 "$talus" new alone
says "new takes a folder, the ground"
# a tool's own code and message
"$talus" tin absent.gpkg -o a.ply 2>err && fail "an absent file was taken"
says "absent.gpkg"

# A folder that holds only site.toml and its files; the place does not matter.
mkdir "a site"
cp "$source_dir"/sample_sites/designed/* "a site"
rm "a site/Makefile"
expect 0 "$talus" run "a site" terrain
[ -s "a site/out/trn.tif" ] || fail "no terrain was made"
expect 0 sh -c 'cd "$2" && exec "$1" run V=1 blocks' here "$talus" "a site"
prints "talus-blocks"
