// Writes the files of talus-blocks.
#include "tools/blocks/outputs.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "io/block_pictures.hpp"
#include "io/blocks_hdf5.hpp"
#include "io/footprints_gdal.hpp"
#include "io/trn_file_gdal.hpp"

namespace talus {
namespace {

std::vector<Vec3> poles_of(const BlocksWork& work, int set) {
  std::vector<Vec3> poles = work.sets[set].measured_poles;
  if (poles.empty())
    for (const Joint& joint : work.joints)
      if (joint.set == set) poles.push_back(joint.plane.normal);
  return poles;
}

// Mean upward normal of the ground over the source, for the stereonet.
Vec3 slope_normal(const BlocksWork& work) {
  Vec3 sum = Vec3::Zero();
  for (int t = 0; t < n_triangles(work.ground); ++t) {
    const auto p = triangle_corners(work.ground, t);
    const Vec3 middle = (p[0] + p[1] + p[2]) / 3;
    if (is_known(work.ground, t) && contains(work.area, Vec2(middle.x(), middle.y())))
      sum += triangle_plane(work.ground, t).normal;
  }
  return sum.squaredNorm() > 0 ? Vec3(sum.normalized()) : Vec3::Zero();
}

void write_pictures(Tool& tool, const BlocksOutputs& files, const BlocksWork& work) {
  if (!files.stereonet.empty()) {
    std::vector<NetSet> sets;
    for (int s = 0; s < static_cast<int>(work.sets.size()); ++s)
      sets.push_back({work.sets[s].set.name,
                      pole(work.sets[s].set.dip, work.sets[s].set.dip_direction),
                      poles_of(work, s)});
    tool.write_text(files.stereonet, svg_of(stereonet(sets, slope_normal(work))));
  }
  if (!files.size_curve.empty())
    tool.write_text(files.size_curve, chart_file(size_curve(work.blocks.volume)));
}

}  // namespace

void write_outputs(Tool& tool, const BlocksOutputs& files, const BlocksWork& work,
                   const Json& report) {
  write_blocks(tool.stage(files.blocks), work.blocks, {{"RUN_ID", tool.run_id()}});
  if (!files.trn.empty())
    write_trn(tool.stage(files.trn), work.is_cut() ? work.mass.bed : work.ground,
              {{{"RUN_ID", tool.run_id()}}, work.accepted_doubts});
  if (!files.footprints.empty()) {
    std::vector<std::vector<Vec2>> rings = work.area.rings;
    for (auto& ring : rings)
      for (Vec2& p : ring) p += work.ground.origin.head<2>();
    write_geopackage(tool.stage(files.footprints), work.blocks.crs_wkt,
                     footprint_layers(work.blocks, rings), {{"RUN_ID", tool.run_id()}});
  }
  write_pictures(tool, files, work);
  tool.report(files.report, report);
}

}  // namespace talus
