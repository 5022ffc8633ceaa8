#include "setup/observed_inputs_gdal.hpp"

#include <algorithm>
#include <cmath>

#include "base/text.hpp"
#include "setup/site_shapes_gdal.hpp"
#include "terrain/extent_text.hpp"

namespace talus {
namespace {

// What the points of a layer say of their size.
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
                         "] lies outside of the known terrain, " + "at (" +
                         text(first.x() + trn.origin.x(), 10) + ", " +
                         text(first.y() + trn.origin.y(), 10) + "); " + extent_text(trn),
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

  [[nodiscard]] std::vector<ObservedPoint> points(const SitePlace& place,
                                                  const SizeField& field) const {
    std::vector<ObservedPoint> out;
    if (place.file.empty()) return out;
    const VectorShapes found = local_shapes(log, site, trn, place);
    std::size_t n_off = 0;
    for (std::size_t i = 0; i < found.shapes.size(); ++i) {
      const Where where{resolved(site, place.file), 0,
                        "layer " + found.layer + ", point " + std::to_string(i + 1)};
      const std::vector<std::string>& words = found.attributes[i];
      ObservedPoint point{found.shapes[i][0].head<2>(), size_of(words[0], field, where), words[1]};
      std::replace(point.date.begin(), point.date.end(), '/', '-');  // GDAL's 2019/05/03
      if (is_on_terrain(point.place))
        out.push_back(point);
      else
        ++n_off;
    }
    if (out.empty()) refuse_outside(place, found.shapes[0][0].head<2>());
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
