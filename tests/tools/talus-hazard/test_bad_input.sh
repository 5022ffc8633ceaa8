# A result that is unknown is not written, and the tool says why and the remedy.
run-probe . 10 blocks=2
expect 0 talus-hazard site.toml run_*.h5 --trn slope.tif -o none --json none.json
says 'no frequency is given: classes, return periods and frequencies are not written'
[ -f none/event_exceed.tif ] && [ ! -e none/class.tif ] && [ ! -e none/hazard.gpkg ] || fail 'classes without frequencies'
grep -q '"why_no_classes": "no frequency is given' none.json || fail 'the result does not say why'

site() { { cat site.toml; printf '%s\n' "$@"; } >bad.toml; }
refused() { words=$1; shift; expect 1 talus-hazard bad.toml "$@" --trn slope.tif -o bad; says "$words"; nothing_left bad/class.tif bad/event_exceed.tif; }
site '[hazard.class.V1]'
refused 'hazard.class.V1: has no frequency' run_0.h5
site '[hazard.class.V1]' 'frequency_per_a = 1' '[hazard.class.V5]' 'frequency_per_a = 1'
refused 'is of no case V1, nor is any other run' run_0.h5
site '[hazard.class.V1]' '[rockfall.cliff]' 'frequency_per_a = 0.02'
refused "the class has no frequency, and the weights of the run's blocks are not frequencies" run_0.h5
site '[hazard.class.V1]' 'failure_probability = 0.1' 'in_years = 50' '[hazard.class.V5]' 'frequency_per_a = 1'
refused 'fails again, class V1 does not' run_0.h5
site '[hazard.class.V1]' 'by_weights = true'
refused 'the key by_weights of [hazard.class.V1] is gone' run_0.h5
site '[hazard]' 'recipe = "switzerland_zh"' '[hazard.class.V1]' 'frequency_per_a = 1'
refused 'neither known nor a file' run_0.h5
sed 's/\["red", "red", "red"\]/["red", "red"]/' "$source_dir/share/hazard/switzerland_ti.toml" >holes.toml
site '[hazard]' 'recipe = "holes.toml"' '[hazard.class.V1]' 'frequency_per_a = 1'
refused 'has 2 entries, expected 3' run_0.h5
says 'holes.toml:'

# a mass that may fail once has a probability and no return period; weights are frequencies
site '[hazard.class.V1]' 'failure_probability = 0.1' 'in_years = 50'
expect 0 talus-hazard bad.toml run_*.h5 --trn slope.tif -o localized
[ ! -e localized/return_period_0kJ.tif ] || fail 'a return period of a single failure'
value=$(gdallocationinfo -valonly -b 1 localized/probability.tif 10 10)
[ "$(echo "$value" | cut -c1-6)" = 0.1000 ] || [ "$(echo "$value" | cut -c1-3)" = 0.1 ] || fail "probability $value"
mkdir weighed
run-probe weighed 10 blocks=2 weight=0.01
sed 's/^width_m = 10/width_m = 5/' "$source_dir/share/hazard/switzerland_ti.toml" >narrow.toml  # one lane
site '[hazard]' 'recipe = "narrow.toml"' '[hazard.class.V1]' '[rockfall.cliff]' 'frequency_per_a = 0.02'
expect 0 talus-hazard bad.toml weighed/run_*.h5 --trn weighed/slope.tif -o weights
value=$(gdallocationinfo -valonly -b 1 weights/return_period_0kJ.tif 10 10)
[ "$(echo "$value" | cut -c1-3)" = 100 ] || fail "return period of a block of 0.01 a year: $value"
