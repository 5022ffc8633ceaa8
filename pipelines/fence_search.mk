# Runs -> where a fence protects an object best, and what it lets through where it stands.
# in: [fence_search.*], SEARCH_FLAGS (e.g. --n-proposals 1)
#     VERIFY_RUNS  how many other runs each proposal stands in (RUNS); 0: none
# out: $(OUT)/search/screen.json and .gpkg, NAME-K.toml a proposal, $(OUT)/verify/NAME-K/run_SEED.h5,
#     $(OUT)/fence_search.json and .gpkg, $(OUT)/search/fence_search_NAME.svg
# The runs that verify have the seeds after those of the search: what was found from runs fits them too well.
# Which proposals there are is known once the runs are screened: a second make, of fence-verified, makes their runs.
VERIFY_RUNS ?= $(RUNS)
$(eval $(call remember,search,$(class_flags) $(SEARCH_FLAGS)))
$(eval $(call remember,verify,$(VERIFY_RUNS)))
.PHONY: fence-search fence-verified
ifneq ($(SITE_FENCE_SEARCHES),)
search_files := $(addprefix $(OUT)/,$(search_products))
$(eval $(call together,$(addprefix $(OUT)/,$(screen_products))))
search_tool = $(Q)$(BIN)talus-fence-search site.toml $(framed_hazard_runs) --trn $(ground_of_runs) $(class_flags) $(SEARCH_FLAGS) --overwrite $(DB)
$(OUT)/search/screen.json: $(run_files) $(OUT)/blocks.h5 $(STAGES)/search.txt $(STAGES)/runs.flags $(STAGES)/search.flags $(STAGES)/search.files | $(OUT)/search
	$(call say,fence-search: $(call counted_runs,$(run_files)) -> candidate lines screened)
	@$(call outcomes,some,$(run_files))
	@$(if $(several_classes),$(foreach class,$(SITE_HAZARD_CLASSES),$(call framed_class_list,$(class));))
	$(search_tool) -o $(OUT)/search/screen.gpkg --json $(OUT)/search/screen.json --proposals $(OUT)/search/new
	@$(if $(is_dry_run),:,sh $(PIPELINES)proposals.sh take $(OUT)/search $(OUT)/verify)
	$(call made,talus-fence-search)
$(OUT)/search:
	@mkdir -p $@
$(eval $(call together,$(search_files)))
$(OUT)/fence_search.json: $(OUT)/search/screen.json $(STAGES)/verify.flags
	+$(if $(is_dry_run),@:,@$(MAKE) --no-print-directory PROPOSALS="$$(sh $(PIPELINES)proposals.sh names $(OUT)/search)" fence-verified)

# --- the second make ---
ifneq ($(filter fence-verified,$(MAKECMDGOALS)),)
verify_seeds := $(if $(filter-out 0,$(VERIFY_RUNS)),$(shell seq $$(($(SEED) + $(RUNS))) $$(($(SEED) + $(RUNS) + $(VERIFY_RUNS) - 1))))
verify_names := $(if $(CASES),$(foreach case,$(CASES),$(addprefix $(case)_,$(verify_seeds))),$(verify_seeds))
# verify_files(PROPOSAL)
verify_files = $(verify_names:%=$(OUT)/verify/$1/run_%.h5)
all_verify_files := $(foreach proposal,$(PROPOSALS),$(call verify_files,$(proposal)))
verify_mass = $(if $(rock_masses),$(shell echo $$((($(seed_of_run) - 1) % $(rock_masses) + 1))))
define verify_rule
$(OUT)/verify/$1/run_%.h5: $(OUT)/search/$1.toml $(OUT)/blocks.h5 | $(OUT)/verify/$1 $(failed_marks)
	$$(call say_run,dda: run_$$* with $1)
	$$(file >$(failed_marks)/verify_$1_run_$$*,none$(tab)$(not_ended))-$$(Q)$(BIN)talus-dda site.toml --add $(OUT)/search/$1.toml \
	  --trn $$(if $$(verify_mass),$(OUT)/rock/bed_$$(verify_mass).tif,$(OUT)/bed.tif) --blocks $$(if $$(verify_mass),$(OUT)/rock/blocks_$$(verify_mass).h5,$(OUT)/blocks.h5) \
	  -o $$@ $$(run_options) --label $1/run_$$* --failures $(failed_marks)/verify_$1_run_$$* --resume --overwrite $(DB)
	$$(call noted,$$@,$$(key_of_run),verify_$1_run_$$*)
$(OUT)/verify/$1:
	@mkdir -p $$@
endef
$(foreach proposal,$(PROPOSALS),$(eval $(call verify_rule,$(proposal))))
$(if $(rock_masses),$(foreach seed,$(verify_seeds),$(eval verify_masses += $(shell echo $$((($(seed) - 1) % $(rock_masses) + 1))))))
$(filter $(call of_other_settings,$(foreach proposal,$(PROPOSALS),$(foreach case,$(or $(CASES),-),\
  $(key_$(filter-out -,$(case))) '$(OUT)/verify/$(proposal)/run_$(if $(CASES),$(case)_)*.h5'))),$(all_verify_files)): of-other-settings
$(all_verify_files): | $(foreach mass,$(sort $(verify_masses)),$(OUT)/rock/blocks_$(mass).h5)
# write_list(PROPOSAL): the names of its runs, for proposals.sh
write_list = $(file >$(OUT)/search/$1.list)$(foreach file,$(call verify_files,$1),$(file >>$(OUT)/search/$1.list,$(file)))
fence-verified: $(all_verify_files)
	$(foreach proposal,$(PROPOSALS),$(call write_list,$(proposal)))
	$(call say,fence-search: $(words $(PROPOSALS)) proposals with $(words $(verify_seeds)) other seeds -> what they let through)
	$(search_tool) -o $(OUT)/fence_search.gpkg --json $(OUT)/fence_search.json --charts $(OUT)/search/charts $$(sh $(PIPELINES)proposals.sh verified $(OUT)/search $(PROPOSALS))
else
fence-verified: fence-search
endif
endif
fence-search: $(search_files) ## runs -> where a fence protects an object best
