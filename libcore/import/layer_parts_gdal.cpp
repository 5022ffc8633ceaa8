// The part of import/open_layer_gdal.hpp that walks the features of a layer and hands on their
// parts.
#include <ogrsf_frmts.h>

#include <algorithm>
#include <string_view>

#include "base/source_path.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "import/layer_names.hpp"
#include "import/layer_shapes_gdal.hpp"
#include "import/open_layer_gdal.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

using Visit = std::function<void(const OGRGeometry&, const OGRFeature&)>;

std::string text_field(const OGRFeature& feature, const char* name) {
  const int index = feature.GetFieldIndex(name);
  return index < 0 ? "" : feature.GetFieldAsString(index);
}

const char* kind_of(OGRwkbGeometryType type) {
  if (fits(type, LayerShape::point)) return "point";
  if (fits(type, LayerShape::line)) return "line";
  return fits(type, LayerShape::polygon) ? "polygon" : "surface";
}

// A line, or a label of a drawing, that is kept to the end: whether it counts depends on the rest.
struct KeptPart {
  std::unique_ptr<OGRGeometry> geometry;
  std::unique_ptr<OGRFeature> feature;
  std::size_t layer;
  bool is_curve;
};

class PartReader {
 public:
  PartReader(OpenLayer& source, const Visit& visit) : source_(source), visit_(visit) {
    source_.n_features = source_.n_parts = 0;
    source_.n_closed_lines = source_.n_curves = source_.n_splines = 0;
    source_.passed_over.clear();
    source_.parts_of.clear();
  }

  void read() {
    for (source_.current = 0; source_.current < source_.layers.size(); ++source_.current) {
      OGRLayer* layer = source_.layers[source_.current];
      layer->ResetReading();
      for (const auto& feature : *layer) add(*feature);
    }
    source_.current = 0;
    add_kept();
  }

  std::int64_t n_null() const { return n_null_; }
  const std::vector<std::string>& drawing_layers() const { return drawing_layers_; }

 private:
  void add(const OGRFeature& feature) {
    if (source_.is_drawing && !is_wanted(feature)) return;
    ++source_.n_features;
    const OGRGeometry* geometry = feature.GetGeometryRef();
    if (geometry == nullptr || geometry->IsEmpty()) {
      ++n_null_;
      return;
    }
    is_label_ = is_spline_ = false;
    is_curve_ = geometry->hasCurveGeometry(TRUE) != 0;
    if (source_.is_drawing) look_at_entity(feature);
    if (geometry->hasCurveGeometry(FALSE) == 0) return descend(*geometry, feature);
    const std::unique_ptr<OGRGeometry> linear(geometry->getLinearGeometry());
    descend(*linear, feature);
  }

  // Features on a sheet of paper have no place on the map.
  bool is_wanted(const OGRFeature& feature) {
    const std::string name = text_field(feature, source_.drawing_field.c_str());
    if (std::find(drawing_layers_.begin(), drawing_layers_.end(), name) == drawing_layers_.end())
      drawing_layers_.push_back(name);
    const std::vector<std::string>& wanted = source_.wanted;
    if (!wanted.empty() && std::none_of(wanted.begin(), wanted.end(), [&name](const auto& word) {
          const std::vector<std::string> parts = parted(word, ',');
          return matches(word, name) || std::any_of(parts.begin(), parts.end(), [&](const auto& p) {
                   return matches(p, name);
                 });
        }))
      return false;
    if (text_field(feature, "PaperSpace") != "1") return true;
    ++source_.n_features;
    ++source_.passed_over["part on paper"];
    return false;
  }

  void look_at_entity(const OGRFeature& feature) {
    const std::string classes = text_field(feature, "SubClasses");
    const auto is_a = [&classes](const char* name) {
      return classes.find(name) != std::string::npos;
    };
    // drawings of AutoCAD R12, and DGN, name no classes
    const char* const style = feature.GetStyleString();
    is_label_ = is_a("AcDbText") || is_a("AcDbMText") ||
                (style != nullptr && std::string_view(style).starts_with("LABEL("));
    is_spline_ = is_a("AcDbSpline");
    is_curve_ = is_curve_ || is_spline_ || is_a("AcDbCircle") || is_a("AcDbEllipse");
  }

  void descend(const OGRGeometry& geometry, const OGRFeature& feature) {
    const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
    if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection)) {
      for (const OGRGeometry* part : *geometry.toGeometryCollection()) descend(*part, feature);
    } else if (fits(geometry.getGeometryType(), source_.role.shape)) {
      add_fitting(geometry, feature);
    } else if (source_.role.shape == LayerShape::polygon && type == wkbLineString) {
      if (is_closed(*geometry.toLineString()))
        keep(geometry, feature);
      else
        ++source_.passed_over["open line"];
    } else {
      ++source_.passed_over[is_label_                                 ? "label"
                            : source_.is_drawing && is_face(geometry) ? "face"
                                                                      : kind_of(type)];
    }
  }

  // Texts of a drawing are points only where nothing else is, or where they are asked for.
  void add_fitting(const OGRGeometry& part, const OGRFeature& feature) {
    if (source_.is_drawing && source_.role.is_of_texts) {
      if (is_label_)
        take(part, feature, false);
      else
        ++source_.passed_over[kind_of(part.getGeometryType())];
    } else if (is_label_) {
      keep(part, feature);
    } else {
      take(part, feature, is_curve_);
    }
  }

  void take(const OGRGeometry& part, const OGRFeature& feature, bool is_curve) {
    ++source_.n_parts;
    source_.n_curves += is_curve ? 1 : 0;
    source_.n_splines += is_spline_ ? 1 : 0;
    ++source_.parts_of[source_.is_drawing ? text_field(feature, source_.drawing_field.c_str())
                                          : source_.layers[source_.current]->GetName()];
    visit_(part, feature);
  }

  void keep(const OGRGeometry& part, const OGRFeature& feature) {
    kept_.push_back({std::unique_ptr<OGRGeometry>(part.clone()),
                     std::unique_ptr<OGRFeature>(feature.Clone()), source_.current, is_curve_});
  }

  // Polygons go before closed lines, points before labels; but in a drawing a closed line is an
  // area as much as a hatch is.
  void add_kept() {
    const bool is_area = source_.role.shape == LayerShape::polygon;
    is_spline_ = false;
    const bool counts = source_.n_parts == 0 || (is_area && source_.is_drawing);
    for (KeptPart& part : kept_) {
      if (!counts) {
        ++source_.passed_over[is_area ? "closed line" : "label"];
        continue;
      }
      source_.current = part.layer;
      if (!is_area) {
        take(*part.geometry, *part.feature, false);
        continue;
      }
      ++source_.n_closed_lines;
      take(area_in(*part.geometry->toLineString()), *part.feature, part.is_curve);
    }
    source_.current = 0;
  }

  static OGRPolygon area_in(const OGRLineString& line) {
    OGRLinearRing ring;
    ring.addSubLineString(&line);
    const int last = ring.getNumPoints() - 1;
    ring.setPoint(last, ring.getX(0), ring.getY(0));
    OGRPolygon polygon;
    polygon.addRing(&ring);
    return polygon;
  }

  OpenLayer& source_;
  const Visit& visit_;
  std::int64_t n_null_ = 0;
  bool is_label_ = false, is_curve_ = false, is_spline_ = false;  // the feature looked at
  std::vector<KeptPart> kept_;
  std::vector<std::string> drawing_layers_;
};

// "2 open lines, 1 point"
std::string in_words(const std::map<std::string, std::int64_t>& counts) {
  std::string words;
  for (const auto& [kind, n] : counts)
    words += (words.empty() ? "" : ", ") + (kind == "part on paper" && n > 1
                                                ? std::to_string(n) + " parts on paper"
                                                : counted(n, kind));
  return words;
}

std::string way_to_shape(const OpenLayer& source) {
  const auto has = [&source](const char* kind) { return source.passed_over.count(kind) > 0; };
  const bool are_contours =
      std::string(source.role.input) == "contours" && source.role.shape == LayerShape::line;
  if (are_contours) {
    if (source.is_drawing && has("face"))
      return "a surface of faces needs no contours: talus-trn " + command_words(source.ref.path) +
             " -o terrain.tif --crs EPSG:code";
    if (has("point")) return "--points makes a TIN of points of the ground";
  }
  if (source.role.shape == LayerShape::line && has("polygon"))
    return (are_contours ? "outlines that each stand at one height: " : "their outlines: ") +
           ("ogr2ogr -nlt MULTILINESTRING lines.gpkg " + command_words(source.ref.path)) +
           (are_contours ? "; bands between two heights are not contours" : "");
  if (source.role.shape == LayerShape::face && has("line"))
    return "contours make a TIN: talus-tin " + command_words(source.ref.path) + " -o tin.ply";
  if (source.role.shape == LayerShape::polygon && has("open line"))
    return "end each line where it begins";
  return "";
}

// Nothing of the shape is there.
InputError without_parts(const OpenLayer& source) {
  const std::string shape = plural(source.role.shape);
  const Where where = where_of_layer(source);
  if (source.n_features == 0 && source.filter.empty())
    return InputError(where, "the layer is empty, expected " + shape);
  if (source.n_features == 0)
    return InputError(
        where, "holds no " + shape + ": the filter \"" + source.filter + "\" leaves no feature");
  const std::string closed = source.role.shape == LayerShape::polygon ? " or closed lines" : "";
  return InputError(where,
                    "holds no " + shape + ", but " + in_words(source.passed_over) + "; expected " +
                        shape + closed,
                    way_to_shape(source));
}

// A layer that was named gives something: else one of several is left out without a word.
void check_named(const OpenLayer& source) {
  if (!source.filter.empty()) return;
  const auto refuse = [&](const std::string& name) {
    return InputError({source.ref.path, 0, "layer " + name},
                      "holds no " + plural(source.role.shape),
                      "leave it out, or choose another one");
  };
  if (!source.is_drawing) {
    for (OGRLayer* layer : source.layers)
      if (source.parts_of.count(layer->GetName()) == 0) throw refuse(layer->GetName());
    return;
  }
  const auto is_there = [&source](const std::string& word) {
    return std::any_of(source.parts_of.begin(), source.parts_of.end(),
                       [&word](const auto& entry) { return matches(word, entry.first); });
  };
  for (const std::string& word : source.wanted) {
    if (is_there(word)) continue;
    for (const std::string& part : parted(word, ','))
      if (!is_there(part)) throw refuse(part);
  }
}

InputError no_such_drawing_layer(const OpenLayer& source, const std::vector<std::string>& names) {
  return InputError({source.ref.path},
                    "the drawing has nothing in a layer \"" + list_of(source.wanted) +
                        "\"; its layers are: " + list_of(names),
                    hint_to_choose(names));
}

// A drawing of which no layer is named has one that holds the shape.
void check_one_drawing_layer(OpenLayer& source) {
  const bool is_chosen = !source.wanted.empty() || names_field(source.filter, source.drawing_field);
  if (is_chosen || source.parts_of.size() < 2) return;
  std::vector<std::string> names, numbers;
  for (const auto& [name, n] : source.parts_of) {
    names.push_back(name);
    numbers.push_back(name + " (" + std::to_string(n) + ")");
  }
  throw InputError({source.ref.path},
                   std::to_string(names.size()) + " layers of the drawing hold " +
                       plural(source.role.shape) + ", expected one; they are: " + list_of(numbers),
                   hint_to_choose(names));
}

void name_drawing_layers(OpenLayer& source) {
  std::vector<std::string> names;
  for (const auto& [name, n] : source.parts_of) names.push_back(name);
  source.name = list_of(names);
}

}  // namespace

Where where_of_layer(const OpenLayer& source) {
  return {source.ref.path, 0, (source.layers.size() > 1 ? "layers " : "layer ") + source.name};
}

Where where_of_feature(const OpenLayer& source, const OGRFeature& feature) {
  const std::string layer = source.is_drawing ? text_field(feature, source.drawing_field.c_str())
                                              : source.layers[source.current]->GetName();
  return {source.ref.path, 0, "layer " + layer + ", feature " + std::to_string(feature.GetFID())};
}

void for_each_part(OpenLayer& source, const Visit& visit) {
  const GdalErrors errors;
  PartReader reader(source, visit);
  reader.read();
  if (source.is_drawing && !source.wanted.empty() && source.n_features == 0 &&
      source.filter.empty())
    throw no_such_drawing_layer(source, reader.drawing_layers());
  if (source.n_features > 0 && source.layers[0]->GetGeomType() == wkbNone)
    throw InputError(where_of_layer(source), "holds rows of a table, which have no geometry",
                     "points of a table become text: ogr2ogr points.csv " +
                         command_words(source.ref.path) + "; then --points");
  if (source.n_features > 0 && reader.n_null() > 0)
    throw InputError(where_of_layer(source),
                     std::to_string(reader.n_null()) + " of " + std::to_string(source.n_features) +
                         " features have no geometry, expected none: is the file truncated?",
                     "copy the file anew; features that are meant to be empty must be deleted");
  if (errors.failed())
    throw InputError(
        where_of_layer(source),
        (source.filter.empty() ? "reading failed: "
                               : "reading with the filter \"" + source.filter + "\" failed: ") +
            errors.failure());
  if (source.n_parts == 0) throw without_parts(source);
  check_named(source);
  if (!source.is_drawing) return;
  check_one_drawing_layer(source);
  name_drawing_layers(source);
}

LayerReading reading_of(const OpenLayer& source) {
  LayerReading reading;
  reading.file = without_layer(source.ref.path);
  reading.layer = source.name;
  reading.where = source.filter;
  reading.noun = singular(source.role.shape);
  reading.n_features = source.n_features;
  reading.n_parts = static_cast<int>(source.n_parts);
  for (const auto& [kind, n] : source.passed_over) reading.n_passed_over += static_cast<int>(n);
  reading.passed_over = in_words(source.passed_over);
  reading.remarks = source.remarks;
  if (source.n_closed_lines > 0)
    reading.remarks.push_back(counted(source.n_closed_lines, "closed line") + " taken as areas");
  if (source.n_curves > 0)
    reading.remarks.push_back(counted(source.n_curves, "curve") + " stroked to lines");
  return reading;
}

void add_remarks(const LayerReading& taken, std::vector<std::string>& notes) {
  if (!taken.where.empty()) notes.push_back(taken.file + ": filter " + taken.where);
  for (const std::string& remark : taken.remarks) notes.push_back(taken.file + ": " + remark);
  if (taken.n_passed_over > 0)
    notes.push_back(taken.file + ": layer " + taken.layer + " also holds " + taken.passed_over +
                    ", passed over");
}

void check_finite(const Vec3& point, const Where& where) {
  if (point.allFinite()) return;
  throw InputError(where, "a coordinate is not finite (x " + text(point.x()) + ", y " +
                              text(point.y()) + ", z " + text(point.z()) + ")");
}

}  // namespace talus
