// Lines of fences from the corners of their sections.
#include "record/fence_lines.hpp"

#include "base/text.hpp"
#include "scene/site_fence.hpp"

namespace talus {
namespace {

// Refuses, or describes, a fence that lies on another one.
std::string doubt_about(const std::string& site_file, const Trn& trn, const FenceLine& one,
                        const FenceLine& other) {
  const Vec2 place = one.line.points.front().head<2>() + trn.origin.head<2>();
  const std::string finding = "lies on fence " + other.line.name + " all along, from " +
                              text(place.x(), 9) + ", " + text(place.y(), 9) + " on";
  if (one.fence != other.fence && !(one.fence->active && other.fence->active))
    return "fence " + one.line.name + " " + finding + ": both count the same blocks";
  throw InputError({site_file, one.fence->line_number, "fence." + one.line.name},
                   finding + ": the same fence would stand there twice",
                   one.fence == other.fence
                       ? "delete the repeated line in the file"
                       : "leave one of the two sections out, or set its active = false");
}

}  // namespace

Where where_of_fence(const std::string& site_file, const FenceSettings& fence) {
  return {site_file, fence.line_number, "fence." + fence.name};
}

std::vector<RecordLine> lines_of_fence(const FenceSettings& fence, const Trn& trn,
                                       const std::vector<std::vector<Vec3>>& corners,
                                       const Where& where) {
  if (corners.empty()) throw InputError(where, "has no line", "give line or file");
  std::vector<RecordLine> lines;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (fence.active) check_feet(fence, trn, corners[i], where);
    std::vector<Vec2> in_plan;
    for (const Vec3& corner : corners[i]) in_plan.push_back(corner.head<2>());
    lines.push_back(
        record_line(fence.name + (corners.size() > 1 ? "." + std::to_string(i + 1) : ""),
                    posts_on_ground(trn, in_plan, fence.post_spacing_m, where)));
  }
  return lines;
}

std::vector<std::string> check_fences_apart(const std::string& site_file, const Trn& trn,
                                            const std::vector<FenceLine>& lines) {
  std::vector<std::string> doubts;
  for (std::size_t later = 0; later < lines.size(); ++later)
    for (std::size_t earlier = 0; earlier < later; ++earlier) {
      const RecordLine &one = lines[later].line, &other = lines[earlier].line;
      if (lies_along(one.points, other.points))
        doubts.push_back(doubt_about(site_file, trn, lines[later], lines[earlier]));
      else if (lies_along(other.points, one.points))
        doubts.push_back(doubt_about(site_file, trn, lines[earlier], lines[later]));
    }
  return doubts;
}

}  // namespace talus
