# What the rules make, a name a file. `make clean` removes these and nothing else, so it is all said here.
tin_products := tin.ply tin.json
trn_products := trn.tif trn.json hillshade.png
block_products := blocks.h5 bed.tif blocks.json blocks.gpkg stereonet.svg sizes.svg
source_products := source.json source.gpkg
check_products := check.html check.json
runout_products := runout.gpkg runout.json runout.csv runout.svg runs.csv sensitivity.csv curves.csv thickness.tif
map_names := reach velocity ke_translational ke_total pass_height_centroid \
  pass_height_top exceedance deposit arrival energy_line
map_products := $(foreach suffix,tif png pdf qml,$(map_names:%=maps/%.$(suffix)))
fence_products := fence.gpkg fence.json fence.csv
change_products := change.tif change.qml change.png change.pdf
places_products := places.json
hazard_products := hazard.json
trace_products := trace.gpkg trace.json links.csv
# maps by limits of the recipe, rasters by objects
hazard_patterns := $(foreach suffix,tif png pdf qml tif.aux.xml png.aux.xml,$(addprefix hazard/,event_exceed.$(suffix) event_frequency.$(suffix) \
  passage_frequency.$(suffix) return_period_*.$(suffix) ke_T*.$(suffix) probability.$(suffix) intensity.$(suffix) class.$(suffix) class_certain.$(suffix))) hazard/hazard.gpkg
trace_patterns := $(foreach suffix,tif png pdf qml tif.aux.xml png.aux.xml,sources/source_*.$(suffix))
profile_products := $(addprefix profile/,profile.gpkg profile.json crossings.csv bins.csv stations.csv ground.svg count.svg energy.svg speed.svg height.svg)
search_products := fence_search.json fence_search.gpkg
screen_products := search/screen.json search/screen.gpkg
report_products := report.html site.qgz
products := $(tin_products) $(trn_products) $(source_products) $(block_products) $(check_products) $(runout_products) $(map_products) \
  $(fence_products) $(change_products) $(places_products) $(hazard_products) $(trace_products) $(profile_products) $(search_products) $(screen_products) $(report_products)

# As patterns of the shell: a style that comes with its raster, runs by seed and case with their checkpoints, the registry, what a stage
# reads, side files that GDAL and QGIS write beside a raster, and hidden names of tools that were killed.
stages_made := tin trn blocks rock check run runs dda runout maps fence place places hazard trace profile search verify report case_*
case_maps := $(foreach suffix,tif png pdf qml tif.aux.xml png.aux.xml,$(map_names:%=maps/*/%.$(suffix)))
made_patterns := thickness.qml rock/blocks_*[0-9].h5 rock/bed_*[0-9].tif rock/bed_*[0-9].tif.aux.xml runs/run_*[0-9].h5 runs/run_*[0-9].h5.part runs/run_*[0-9].h5.part.new \
  without/run_*[0-9].h5 without/run_*[0-9].h5.part without/run_*[0-9].h5.part.new \
  runs.sqlite runs.sqlite-wal runs.sqlite-shm runs.sqlite.late-* data.ok \
  $(addsuffix .aux.xml,$(filter %.tif %.png,$(products))) $(hazard_patterns) $(trace_patterns) $(case_maps) fences/*/fence.json fences/*/fence.gpkg stages/class_*.list stages/class_*.list.there stages/class_*.list.in_parts \
  search/*-[1-9].toml search/*-10.toml search/*.list search/*.list.there search/new/*.toml search/charts/fence_search_*.svg \
  verify/*-*/run_*[0-9].h5 verify/*-*/run_*[0-9].h5.part verify/*-*/run_*[0-9].h5.part.new stages/failed/verify_*_run_*[0-9] \
  $(foreach ending,txt flags files,$(stages_made:%=stages/%.$(ending))) \
  stages/runs.list stages/without.list stages/runs.list.there stages/without.list.there stages/runs.list.in_parts stages/without.list.in_parts \
  parts/*-of-*.h5 parts/*-of-*.runs parts/without/*-of-*.h5 parts/without/*-of-*.runs shards/*-of-*.list shards/*-of-*.list.there \
  shards/*-of-*.sqlite shards/*-of-*.sqlite-wal shards/*-of-*.sqlite-shm shards/*-of-*.sqlite.late-* \
  shards/merged shards/jobs shards/log/*_*.txt stages/.progress* \
  stages/.digests stages/.lock stages/.now stages/made/runs stages/made/*-of-* stages/failed/run_*[0-9] stages/failed/without_run_*[0-9] \
  $(addsuffix .*.part-*-*,$(sort $(dir $(products))) maps/*/ fences/*/ runs/ without/ parts/ parts/without/ rock/ stages/ shards/ hazard/ sources/ search/new/ search/charts/ verify/*-*/)
# The mark of a folder that the pipeline has written into; it goes last.
mark_of_out := stages/site.mk
made_folders := maps/* maps fences/* fences hazard sources profile search/new search/charts search verify/* verify runs without parts/without parts rock shards/log shards stages/failed stages/made stages
