# A new site beside this one: make new-site NAME=folder DEM=ground SOURCE=release-polygon
# The name goes by the environment and holds no order, neither for make nor for the shell.
ifneq ($(and $(filter new-site,$(MAKECMDGOALS)),$(findstring $$,$(value NAME))),)
$(error NAME is $(value NAME), expected letters (a to z), digits, _ and -)
endif
.PHONY: new-site
new-site: ## NAME=... DEM=... SOURCE=... (ROCKFALL=yes): a folder for another slope, beside this one
	@sh "$$pipelines/new_site.sh" "$$new_name" "$$new_ground" "$$new_source" "$$pipelines" \
	  "$$tools" "$$rockfall"
new-site: export new_name = $(if $(NAME),$(if $(findstring /,$(NAME)),,../)$(NAME))
new-site: export new_ground = $(DEM)
new-site: export new_source = $(SOURCE)
new-site: export pipelines = $(PIPELINES:%/=%)
new-site: export tools = $(BIN)
new-site: export rockfall = $(ROCKFALL)
