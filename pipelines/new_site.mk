# A new site beside this one: make new-site NAME=folder DEM=elevations-or-contours SOURCE=release-polygon
.PHONY: new-site
new-site: ## NAME=... DEM=... SOURCE=...: a folder for another slope, beside this one
	@sh $(PIPELINES)new_site.sh "$(if $(findstring /,$(NAME)),$(NAME),$(NAME:%=../%))" "$(DEM)" "$(SOURCE)" $(PIPELINES)
