// libcore/setup/site_dams_gdal.hpp: public
// The [dam.*] of a site, burnt into its terrain.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/input_log.hpp"
#include "record/crossings.hpp"
#include "site/site.hpp"
#include "terrain/dam.hpp"

namespace talus {

/// The dam, or of a section with several lines the dams, that a section says, whether it is built
/// or not, in the local coordinates of the terrain; several are named NAME.1, NAME.2 ...
struct SiteDam {
  std::string name;
  DamShape shape;
};
/// Throws InputError for a section without a line or with two, and for a line that crosses itself.
[[nodiscard]] std::vector<SiteDam> dams_of(InputLog& log, const Site& site, const Trn& trn,
                                           const DamSettings& settings);

struct BuiltDam {
  std::string name;
  Dam dam;
  DamBurn burn;
};

/// Burns all that are active into `trn`, each laid on the ground that was there before all of
/// them. Tells the log which dams cells of this size cannot represent. Throws InputError as
/// dams_of(), for a dam that cannot be built where it is (DamFault), and for two that share a node.
std::vector<BuiltDam> build_dams(InputLog& log, const Site& site, Trn& trn);

/// The two lines that a run watches for a dam in the ground of `trn`, with a point every ten
/// metres: the crest, and, where blocks come to the dam, one as far before it as the uphill face
/// would run on level ground and half the height more. Of a gallery they are the edges of the roof,
/// that of the valley first, at its height or on higher ground.
struct DamLines {
  const DamSettings* settings = nullptr;
  RecordLine crest, before;
  int uphill = 1;  ///< +1: left of both seen from their first points, -1: right
};
struct WatchedDams {
  std::vector<DamLines> dams;  ///< those in the ground
  /// Where the ground holds other dams than the active ones, or another shape of them; for whoever
  /// computes with it to throw.
  std::optional<InputError> other_ground;
};
/// Of all that are active. Throws InputError as dams_of() and posts_on_ground().
[[nodiscard]] WatchedDams watched_dams(InputLog& log, const Site& site, const Trn& trn);

/// Roofs of the galleries that are active in the ground of `trn`. Throws InputError as dams_of().
[[nodiscard]] std::vector<RoofPiece> gallery_roofs(InputLog& log, const Site& site, const Trn& trn);

/// "dam valley: 62 m long, crest 4.9 to 5.2 m above the ground, fill 1240 m3, cut 310 m3 ..."
[[nodiscard]] std::string sentence_on(const BuiltDam& built);

}  // namespace talus
