# Files that the rules make, a name a file. `make clean` removes these and nothing else.
import_products := inputs.gpkg import.json
tin_products := tin.ply tin.json
trn_products := trn.tif trn.json hillshade.png
block_products := blocks.h5 bed.tif blocks.json blocks.gpkg stereonet.svg sizes.svg
source_products := source.json source.gpkg
stability_products := $(addprefix stability/,stability.json blocks.gpkg levels.svg)
check_products := check.html check.json
runout_products := runout.gpkg runout.json runout.csv runout.svg runs.csv sensitivity.csv \
  curves.csv thickness.tif
map_names := reach velocity ke_translational ke_total pass_height_centroid \
  pass_height_top exceedance deposit arrival energy_line
map_products := $(foreach suffix,tif png pdf qml,$(map_names:%=maps/%.$(suffix)))
compare_products := maps/compare.tif maps/compare.qml maps/compare.png maps/compare.pdf
fence_products := fence.gpkg fence.json fence.csv
change_products := change.tif change.qml change.png change.pdf
places_products := places.json
calibrate_products := calibrate.gpkg calibrate.json calibrate.toml
hazard_products := hazard.json
trace_products := trace.gpkg trace.json links.csv
# maps by limits of the recipe, rasters by objects
raster_suffixes := tif png pdf qml tif.aux.xml png.aux.xml
hazard_names := event_exceed event_frequency passage_frequency return_period_* ke_T* probability \
  intensity class class_certain
hazard_patterns := $(foreach suffix,$(raster_suffixes),$(hazard_names:%=hazard/%.$(suffix))) \
  $(foreach suffix,gpkg gpkg.aux.xml,hazard/hazard.$(suffix) hazard/filing.$(suffix))
trace_patterns := $(raster_suffixes:%=sources/source_*.%)
profile_products := $(addprefix profile/,profile.gpkg profile.json crossings.csv bins.csv \
  stations.csv ground.svg count.svg energy.svg speed.svg height.svg)
search_products := fence_search.json fence_search.gpkg
screen_products := search/screen.json search/screen.gpkg
report_products := report.html site.qgz
products := $(foreach stage,import tin trn source block stability check runout map compare fence \
  change \
  places calibrate hazard trace profile search screen report,$($(stage)_products))

# As patterns of the shell: a style that comes with its raster, runs with their checkpoints, the
# registry, inputs of a stage, side files that GDAL and QGIS write beside rasters and GeoPackages,
# and hidden names of tools that were killed.
run_folders := runs runs/* without without/* verify/*-* verify/*-*/*
run_patterns := run_*[0-9].h5 run_*[0-9].h5.part run_*[0-9].h5.part.new ensemble.json .lock \
  .auto/ensemble.json
stages_made := import tin trn blocks rock stability check run runs dda runout maps fence place \
  places calibrate hazard trace profile search verify report
registries := sqlite sqlite-wal sqlite-shm sqlite.late-*
made_patterns := thickness.qml $(foreach end,h5 tif tif.aux.xml,rock/*_*[0-9].$(end)) \
  $(foreach folder,$(run_folders),$(run_patterns:%=$(folder)/%)) \
  $(registries:%=runs.%) $(registries:%=shards/*-of-*.%) data.ok \
  $(addsuffix .aux.xml,$(filter %.tif %.png %.gpkg,$(products))) \
  $(hazard_patterns) $(trace_patterns) \
  $(foreach suffix,$(raster_suffixes),$(map_names:%=maps/*/%.$(suffix))) \
  fences/*/fence.json fences/*/fence.gpkg search/*-[1-9].toml search/*-10.toml \
  search/new/*.toml search/charts/fence_search_*.svg \
  $(foreach ending,txt flags files,$(stages_made:%=stages/%.$(ending))) \
  parts/*-of-*.h5 parts/without/*-of-*.h5 shards/merged shards/jobs shards/log/*_*.txt \
  stages/.digests stages/.lock stages/.now .failed \
  $(addsuffix .*.part-*,$(sort $(dir $(products))) $(run_folders:%=%/) maps/*/ fences/*/ parts/ \
  parts/without/ rock/ stages/ shards/ hazard/ sources/ search/new/ search/charts/)
# The mark of a folder that the pipeline has written into; it goes last.
mark_of_out := stages/site.mk
made_folders := stability maps/* maps fences/* fences hazard sources profile search/new \
  search/charts search runs/.auto without/.auto verify/*-*/.auto verify/*-*/* verify/*-* verify \
  runs/* runs without/* without parts/without parts rock shards/log shards stages variant
