// Reads the observations of [observed.*] and checks them.
#include "setup/observed_inputs_gdal.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "terrain/extent_text.hpp"

namespace talus {
namespace {

// Field of a layer with the size of its points.
struct SizeField {
  const char* name;
  double least, most;
  bool is_needed;
};
// A larger boulder, or a scar higher than any tree, has another unit.
constexpr SizeField volume_field{"volume_m3", 1e-6, 1e6, false};
constexpr SizeField height_field{"height_m", 0, 100, true};

struct Reader {
  InputLog& log;
  const Site& site;
  const Trn& trn;
  const ObservedSettings& section;

  [[nodiscard]] bool is_on_terrain(const Vec2& place) const {
    return !std::isnan(elevation_at(trn, place.x(), place.y()));
  }

  [[noreturn]] void refuse_outside(const SitePlace& place, const Vec2& first) const {
    throw InputError({resolved(site, place.file)},
                     place.layer + " of [" + place.section +
                         "] lies outside of the known terrain, at (" +
                         place_text(first, trn.origin) + "); " + extent_text(trn),
                     "make the terrain larger, or check the order (x east, y north) and the "
                     "coordinate system of the layer");
  }

  static double size_of(const std::string& words, const SizeField& field, const Where& where) {
    double size = not_given;
    if (words.empty() && !field.is_needed) return size;
    if (parse_double(words, size) && size >= field.least && size <= field.most) return size;
    throw InputError(
        where,
        words.empty() ? std::string("has no ") + field.name
                      : std::string(field.name) + " is " + words + ", expected " +
                            text(field.least) + " to " + text(field.most),
        field.is_needed ? "field height_m holds the height of the scar above the ground in metres; "
                          "take out points without one"
                        : "field volume_m3 holds the volume of the boulder in cubic metres; empty "
                          "it where that is not known");
  }

  // Map coordinates; NaN: not known.
  static Vec3 start_of(const std::string& x, const std::string& y, const Where& where) {
    Vec3 start = Vec3::Constant(not_given);
    if ((x.empty() && y.empty()) || (parse_double(x, start.x()) && parse_double(y, start.y())))
      return start;
    throw InputError(where, "starts at x \"" + x + "\" and y \"" + y + "\", expected two numbers",
                     "start_x_m and start_y_m are map coordinates in the system of the site file");
  }

  // Distances from own starts and from a common one do not go together.
  void add_starts(const std::vector<Vec3>& starts, std::vector<ObservedPoint>& boulders) const {
    const auto n = std::count_if(starts.begin(), starts.end(),
                                 [](const Vec3& start) { return !std::isnan(start.x()); });
    if (n == 0) return;
    if (n < std::ssize(starts))
      throw InputError({resolved(site, section.boulders_file)},
                       "has starts of " + std::to_string(n) + " of " +
                           counted(std::ssize(starts), "boulder") + ", expected all or none",
                       "give start_x_m and start_y_m of all, or make two sections of them");
    const std::vector<Vec3> local =
        local_points(log, site, trn, starts, "observed." + section.name, "boulders_file");
    for (std::size_t i = 0; i < local.size(); ++i) boulders[i].start = local[i].head<2>();
  }

  [[nodiscard]] std::vector<ObservedPoint> points(const SitePlace& place,
                                                  const SizeField& field) const {
    std::vector<ObservedPoint> out;
    if (place.file.empty()) return out;
    const VectorShapes found = local_shapes(log, site, trn, place);
    std::vector<Vec3> starts;
    std::size_t n_off = 0;
    for (std::size_t i = 0; i < found.shapes.size(); ++i) {
      const Where where{resolved(site, place.file), 0,
                        "layer " + found.layer + ", point " + std::to_string(i + 1)};
      const std::vector<std::string>& words = found.attributes[i];
      ObservedPoint point;
      point.place = found.shapes[i][0].head<2>();
      point.size = size_of(words[0], field, where);
      point.date = words[1];
      std::replace(point.date.begin(), point.date.end(), '/', '-');  // GDAL's 2019/05/03
      const Vec3 start =
          words.size() > 2 ? start_of(words[2], words[3], where) : Vec3::Constant(not_given);
      if (is_on_terrain(point.place)) {
        out.push_back(point);
        starts.push_back(start);
      } else {
        ++n_off;
      }
    }
    if (out.empty()) refuse_outside(place, found.shapes[0][0].head<2>());
    add_starts(starts, out);
    if (n_off > 0)
      log.warn(place.layer + " of [" + place.section + "]: " + std::to_string(n_off) + " of " +
               counted(static_cast<std::int64_t>(found.shapes.size()), "point") +
               " lie outside of the known terrain and are left out");
    return out;
  }

  void add_outline(ObservedEvent& event) const {
    const SitePlace place = outline_of(section);
    if (place.file.empty()) return;
    const VectorShapes found = local_shapes(log, site, trn, place);
    bool any = false;
    for (const std::vector<Vec3>& shape : found.shapes) {
      std::vector<Vec2>& ring = event.outline.rings.emplace_back();
      for (const Vec3& corner : shape) {
        ring.emplace_back(corner.head<2>());
        any = any || is_on_terrain(ring.back());
      }
    }
    event.polygon = found.polygon;
    if (!any) refuse_outside(place, event.outline.rings[0][0]);
  }
};

}  // namespace

std::vector<ObservedEvent> observed_events(InputLog& log, const Site& site, const Trn& trn) {
  std::vector<ObservedEvent> events;
  for (const ObservedSettings& section : site.observed) {
    if (section.boulders_file.empty() && section.scars_file.empty() && section.outline_file.empty())
      throw InputError({site.file, section.line},
                       "[observed." + section.name + "] says nothing that was observed",
                       "give boulders_file, scars_file or outline_file");
    const Reader reader{log, site, trn, section};
    ObservedEvent& event = events.emplace_back();
    event.name = section.name;
    event.boulders = reader.points(boulders_of(section), volume_field);
    event.scars = reader.points(scars_of(section), height_field);
    reader.add_outline(event);
  }
  return events;
}

}  // namespace talus
