// tools/fence-search/output.hpp
// Outputs of talus-fence-search: proposals as sections of a site file, JSON, layers, a chart.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/geopackage_gdal.hpp"
#include "tools/fence-search/inputs.hpp"
#include "tools/frame/tool.hpp"

namespace talus {

/// An option that meets the demand, with fences that have names and posts of their own.
struct Proposal {
  std::string name;  ///< "house-1"
  std::vector<Fence> fences;
  FenceOption option;
  int n_moves = 0;  ///< of the refinement; 0: it is on its candidate line
  std::optional<VerifiedFence> verified;
};

/// A search with its answer.
struct SearchAnswer {
  FenceSearchResult result;
  std::vector<Proposal> proposals;  ///< by cost
  int best = -1;  ///< the cheapest of those that hold; -1: none, or nothing was verified
};

/// How a verified share compares with the prediction: "as predicted", "better than predicted",
/// "worse than predicted"; "" where it was not verified or nothing bounds the shares.
[[nodiscard]] std::string comparison_of(const Proposal& proposal);

/// Sections [fence.*] of a proposal, to be added to the site file (talus-dda --add).
[[nodiscard]] std::string proposal_toml(const Proposal& proposal, const Vec3& origin);

/// The answer in a sentence or two.
[[nodiscard]] std::string answer_text(const SearchCase& search, const SearchAnswer& answer);

[[nodiscard]] Json search_json(const SearchCase& search, const SearchAnswer& answer,
                               const Vec3& origin);

/// Layers candidates, front, proposals and posts of all searches.
[[nodiscard]] std::vector<VectorLayer> search_layers(const std::vector<SearchCase>& searches,
                                                     const std::vector<SearchAnswer>& answers,
                                                     const Vec3& origin);

/// Cost against the share of hits that is let through: the front, proposals as predicted and as
/// verified (SVG).
[[nodiscard]] std::string search_chart(const SearchCase& search, const SearchAnswer& answer);

}  // namespace talus
