# The chain of tools for one site, included by sample_sites/<site>/Makefile, which sets
#   CONTOURS             the contour map
#   TIN_FLAGS, TRN_FLAGS options of the tools
# Every rule is one tool: files in, files out. BIN= takes the tools from the search path.

PIPELINES := $(dir $(lastword $(MAKEFILE_LIST)))
OUT ?= out
BIN ?= $(PIPELINES)../build/release/tools/

.DEFAULT_GOAL := all
.DELETE_ON_ERROR:
.SUFFIXES:

.PHONY: all terrain blocks clean help
all: blocks
terrain: $(OUT)/trn.tif ## contours -> TIN -> TRN
blocks: $(OUT)/blocks.h5 ## source and joints -> blocks and their bed

$(OUT):
	mkdir -p $@

include $(PIPELINES)tin.mk
include $(PIPELINES)trn.mk
include $(PIPELINES)blocks.mk

# Sites whose data are not in the repository keep a list of what they need, with checksums.
ifneq ($(wildcard manifest.sha256),)
.PHONY: data
data: ## check the site's data against manifest.sha256
	sha256sum --check --quiet manifest.sha256
$(OUT)/tin.ply: | data
endif

clean: ## remove everything that was made
	rm -rf $(OUT)

help: ## this list
	@sed -n 's/^\([a-z]*\):.*## \(.*\)/\1: \2/p' $(MAKEFILE_LIST)
