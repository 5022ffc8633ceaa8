# Implausible joints, with the line of the site file.
. "$source_dir/tests/tools/talus-blocks/scene.sh"
make_site
refused() {
  sed "$1" site.toml >bad.toml
  expect 1 talus-blocks bad.toml --trn trn.tif -o blocks.h5 --no-db
  nothing_left blocks.h5
}
refused 's/^spacing_m = 3/spacing_m = 0/'
says "bad.toml:12: spacing_m is 0, expected above 0"
refused 's/^spacing_m = 3/spacing_m = -2/'
says "spacing_m is -2, expected above 0"
refused 's/^dip_deg = 35/dip_deg = 95/'
says "bad.toml:10: dip_deg is 95, expected 0 to 90"
says "hint: dip is the steepest slope"
refused 's/^dip_deg = 35/dip_degree = 35/'
says "unknown key dip_degree in [joints.sliding]"
says "hint: did you mean dip_deg?"
refused 's/^dip_deg = 35//'
says "dip_deg of [joints.sliding] is not given"
refused 's/^spacing_m = [34]/spacing_m = 0.02/'
says "blocks, expected at most 20000"
says "hint: widen the spacings, or set source.max_blocks"

# Too few or too wide joints are a warning with the reason, not an error.
expect 0 talus-blocks site.toml --trn trn.tif -o wide.h5 --no-db --set joints.sliding.spacing_m=500 \
  --set joints.rear.spacing_m=500 --set joints.lateral.spacing_m=500 --set joints.sliding.offset_m=100 \
  --set joints.rear.offset_m=100 --set joints.lateral.offset_m=100
says "the mass stays in one piece: no joint crosses it"
sed '/^\[joints/,/^$/d' site.toml >none.toml
expect 0 talus-blocks none.toml --trn trn.tif -o none.h5 --no-db
says "the mass stays in one piece: there are no [joints.*]"
expect 0 talus-blocks site.toml --trn trn.tif -o discs.h5 --no-db --set joints.sliding.persistence=0.1 \
  --set joints.rear.persistence=0.1 --set joints.lateral.persistence=0.1 --set joints.sliding.disc_diameter_m=1 \
  --set joints.rear.disc_diameter_m=1 --set joints.lateral.disc_diameter_m=1
says "the mass stays in one piece: no joint is persistent enough"
