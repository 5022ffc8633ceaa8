# Terrain, blocks and site file -> a look before the runs: will it move, is all in place, how long.
# in: site.toml, CHECK_FLAGS (e.g. --probe-s 0, --accept-doubts)
#     DDA_FLAGS    --settle of them, since it says how the blocks start
# out: $(OUT)/check.html, $(OUT)/check.json
# An implausible site ends make here, before anything is computed; the page says why, and the next
# make looks again.
how_runs_start := $(filter --settle,$(DDA_FLAGS))
$(eval $(call remember,check,$(CHECK_FLAGS) $(how_runs_start)))
check_files := $(addprefix $(OUT)/,$(check_products))
check: $(check_files) ## a look before the runs: will the mass move, is all in its place, how long
$(eval $(call together,$(check_files)))
n_runs = $(word 5,$(status_runs)) * $(words $(kinds))
$(OUT)/check.html: $(OUT)/blocks.h5 $(STAGES)/run.txt $(STAGES)/check.flags $(STAGES)/check.files \
  $(STAGES)/trace.txt $(STAGES)/trace.files $(stability_for_others)
	$(call not_in_a_shard,$@)
	$(call say,check: a look before the runs)
	$(Q)$(BIN)talus-check $(site) --trn $(OUT)/trn.tif --bed $(OUT)/bed.tif \
	  --blocks $(OUT)/blocks.h5 -o $(OUT)/check.html --report $(OUT)/check.json \
	  --reports $(filter %.json,$(import_files) $(tin_files) $(trn_files) $(block_files) \
	  $(stability_for_others)) \
	  --runs $$(($(n_runs))) $(inputs_given) $(CHECK_FLAGS) $(how_runs_start) --overwrite $(DB) \
	  || { code=$$?; touch -c -d @0 $(check_files); exit $$code; }
	$(call made,talus-check)
