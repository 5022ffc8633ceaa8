# --print-config shows values and where they came from; --set overrides the file.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
expect 0 blocks --print-config --set source.depth_m=7
prints "source.depth_m = 7  # cli"
prints "joints.sliding.dip_deg = 35  # file, line 10"
prints "source.seed = 1  # default"
expect 2 blocks --set source.depth=7
says "unknown key depth in [source]"
expect 2 blocks --set source.depth_m
says "is not section.key=value"
expect 2 talus-blocks site.toml -o blocks.h5
expect 2 blocks --no-such-option
