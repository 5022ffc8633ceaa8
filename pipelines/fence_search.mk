# Runs -> where a fence protects an object best, and which blocks it lets through when built.
# in: [fence_search.*], SEARCH_FLAGS (e.g. --n-proposals 1)
#     VERIFY_RUNS  in how many other runs each proposal is tried (RUNS); 0: none
# out: $(OUT)/search/screen.json and .gpkg, NAME-K.toml a proposal, verify/NAME-K/run_SEED.h5,
#     $(OUT)/fence_search.json and .gpkg, $(OUT)/search/charts/fence_search_NAME.svg
# The runs that verify have the seeds after those of the search: a proposal found from runs fits
# them too well.
VERIFY_RUNS ?= $(filter-out auto,$(RUNS))
$(eval $(call remember,search,$(SEARCH_FLAGS)))
$(eval $(call remember,verify,$(VERIFY_RUNS)))
.PHONY: fence-search
ifneq ($(SITE_FENCE_SEARCHES),)
search_files := $(addprefix $(OUT)/,$(search_products))
$(eval $(call together,$(addprefix $(OUT)/,$(screen_products))))
search_tool = $(BIN)talus-fence-search $(site) $(OUT)/runs --trn $(ground_of_runs) \
  $(inputs_given) $(SEARCH_FLAGS) --overwrite $(DB)
# verify(NAME,OPTIONS): runs with a proposed fence
verify = $(batch) --into verify/$1 --seed $(word 4,$(call status_of,runs)) \
  $(call option_of,VERIFY_RUNS,--runs) $2 -- --add $(OUT)/search/$1.toml $(DDA_FLAGS)
searches := $(filter fence-search,$(wanted))
verify_masses := $(if $(and $(searches),$(rock_masses)),$(wordlist 6,9999,$(shell \
  $(batch) --into verify/any --seed $(word 4,$(status_runs)) $(call option_of,VERIFY_RUNS,--runs) \
  --status --no-db --part 0/1)))
$(OUT)/search/screen.json: $(OUT)/runs/ensemble.json $(STAGES)/search.txt $(STAGES)/search.flags \
  $(STAGES)/search.files
	$(call say,fence-search: runs -> candidate lines screened)
	@mkdir -p $(OUT)/search
	$(Q)$(search_tool) -o $(OUT)/search/screen.gpkg --json $@ --proposals $(OUT)/search/new
	@cd $(OUT)/search && for old in *-*.toml; do [ -f new/$$old ] || rm -f $$old; done && \
	  for new in new/*.toml; do [ ! -f $$new ] || cmp -s $$new $${new#new/} || cp $$new .; done && \
	  rm -r new
	$(call made,talus-fence-search)
proposals = $(patsubst $(OUT)/search/%.toml,%,$(wildcard $(OUT)/search/*-*.toml))
verify_all = $(if $(filter 0,$(VERIFY_RUNS)),,$(foreach name,$(proposals),$(Q)$(call \
  verify,$(name),$(DB)) $(some_failed)$(newline)))
verified = $(if $(filter 0,$(VERIFY_RUNS)),,$(foreach \
  name,$(proposals),--verified $(name)=$(OUT)/verify/$(name)))
$(eval $(call together,$(search_files)))
$(OUT)/fence_search.json: $(OUT)/search/screen.json $(STAGES)/verify.flags \
  $(verify_masses:%=$(OUT)/rock/blocks_%.h5)
	$(call say,fence-search: proposals with other seeds -> what they let through)
	$(verify_all)
	$(Q)$(search_tool) -o $(OUT)/fence_search.gpkg --json $@ --charts $(OUT)/search/charts $(verified)
endif
fence-search: $(search_files) ## runs -> where a fence protects an object best
