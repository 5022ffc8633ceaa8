// Reads TINs of other programs: DXF, LandXML, OBJ, PLY.
#include "import/tin_files_gdal.hpp"

#include <cpl_minixml.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <sstream>
#include <tuple>
#include <utility>

#include "base/error.hpp"
#include "base/file_paths.hpp"
#include "base/length_units.hpp"
#include "base/read_file.hpp"
#include "base/source_path.hpp"
#include "base/text.hpp"
#include "base/words.hpp"
#include "geometry/rounding.hpp"
#include "import/crs_place_gdal.hpp"
#include "import/drawing_unit_gdal.hpp"
#include "import/raw_inputs_gdal.hpp"
#include "import/systems_gdal.hpp"
#include "io/crs_gdal.hpp"
#include "io/errors_gdal.hpp"
#include "io/mesh.hpp"
#include "io/tin_ply.hpp"
#include "terrain/grid_tin.hpp"

namespace talus {
namespace {

bool is_ply(const std::string& path) {
  const std::string head = first_bytes(path, 4);
  return extension_of(path) == ".ply" || head.starts_with("ply\n") || head.starts_with("ply\r");
}

bool is_obj(const std::string& path) { return extension_of(path) == ".obj"; }

bool is_landxml(const std::string& path) {
  const std::string extension = extension_of(path);
  if (extension != ".xml" && extension != ".landxml") return false;
  return first_bytes(path, 4096).find("LandXML") != std::string::npos;
}

// --- triangles from faces ------------------------------------------------------------------------

// Points in one place become one; map coordinates until the end.
class FaceCollector {
 public:
  int point(const Vec3& p) {
    const auto [at, is_new] =
        number_.try_emplace(std::tuple(p.x(), p.y(), p.z()), static_cast<int>(tin_.points.size()));
    if (is_new) tin_.points.push_back(p);
    return at->second;
  }
  int new_point(const Vec3& p) {
    tin_.points.push_back(p);
    return static_cast<int>(tin_.points.size()) - 1;
  }
  // Counter-clockwise; a triangle without an area in plan is not ground.
  void triangle(int a, int b, int c) {
    const Vec3 &p = tin_.points[a], &q = tin_.points[b], &r = tin_.points[c];
    const double area = (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
    if (area > 0)
      tin_.triangles.push_back({a, b, c});
    else if (area < 0)
      tin_.triangles.push_back({a, c, b});
    else
      ++n_upright;
  }
  Tin take() {
    Vec3 low = tin_.points.front();
    for (const Vec3& p : tin_.points) low = low.cwiseMin(p);
    tin_.origin = Vec3(std::floor(low.x() / 100) * 100, std::floor(low.y() / 100) * 100, 0);
    for (Vec3& p : tin_.points) p -= tin_.origin;
    return std::move(tin_);
  }
  [[nodiscard]] std::int64_t n_triangles() const {
    return static_cast<std::int64_t>(tin_.triangles.size());
  }

  std::int64_t n_upright = 0;

 private:
  Tin tin_;
  std::map<std::tuple<double, double, double>, int> number_;
};

void note_upright(const FaceCollector& faces, TinFile& file, const std::string& path) {
  if (faces.n_upright > 0)
    file.notes.push_back(path + ": " + counted(faces.n_upright, "triangle") +
                         " without an area in plan left out");
}

// --- drawings ------------------------------------------------------------------------------------

constexpr LayerRole faces_role{LayerShape::face, "faces"};

struct DrawingCounts {
  std::int64_t n_faces = 0, n_quads = 0, n_others = 0;
};

void add_ring(const OGRLinearRing& ring, double unit_m, FaceCollector& faces, DrawingCounts& counts,
              const Where& where) {
  std::vector<int> corners;
  for (int i = 0; i < ring.getNumPoints(); ++i) {
    const Vec3 point(ring.getX(i), ring.getY(i), ring.getZ(i));
    check_finite(point, where);
    const int id = faces.point(unit_m * point);
    if (std::find(corners.begin(), corners.end(), id) == corners.end()) corners.push_back(id);
  }
  if (corners.size() != 3 && corners.size() != 4) {
    ++counts.n_others;
    return;
  }
  ++counts.n_faces;
  faces.triangle(corners[0], corners[1], corners[2]);
  if (corners.size() == 3) return;
  ++counts.n_quads;
  faces.triangle(corners[0], corners[2], corners[3]);
}

void add_face(const OGRGeometry& geometry, double unit_m, FaceCollector& faces,
              DrawingCounts& counts, const Where& where) {
  const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
  if (type != wkbPolyhedralSurface && type != wkbTIN)
    return add_ring(*geometry.toPolygon()->getExteriorRing(), unit_m, faces, counts, where);
  for (const OGRGeometry* part : *geometry.toPolyhedralSurface())
    add_face(*part, unit_m, faces, counts, where);
}

double unit_of_faces(const LayerRef& choice, const OpenLayer& source, TinFile& file) {
  const std::string drawing = file_of(choice.path);
  if (const std::string doubt = doubt_on_unit(drawing, choice.unit_m); !doubt.empty())
    file.doubts.push_back(doubt_on({drawing}, doubt));
  const DrawingUnit unit = drawing_unit(drawing);
  OGREnvelope e;
  if (source.layer->GetExtent(&e) != OGRERR_NONE) e = {};
  const std::string option = "--unit-m ";
  return scale_of_drawing(
      drawing, choice.unit_m, 1, {drawing}, {e.MinX, e.MinY, e.MaxX, e.MaxY},
      {option + (unit.metres > 0 ? text(unit.metres) : "METRES") + ", for plan and heights",
       option + "1"});
}

std::string sentence_on(const DrawingCounts& counts) {
  std::string words = counted(counts.n_faces, "face");
  if (counts.n_quads > 0)
    words += ", " + std::to_string(counts.n_quads) + " of them of four corners, cut in two";
  if (counts.n_others > 0)
    words += "; " + std::to_string(counts.n_others) +
             " that are neither triangles nor of four corners passed over";
  return words;
}

TinFile read_drawing(const LayerRef& choice) {
  TinFile file;
  OpenLayer source = open_layer(choice, faces_role);
  const double unit_m = unit_of_faces(choice, source, file);
  FaceCollector faces;
  DrawingCounts counts;
  for_each_part(source, [&](const OGRGeometry& part, const OGRFeature& feature) {
    add_face(part, unit_m, faces, counts, where_of_feature(source, feature));
  });
  file.taken = reading_of(source);
  file.taken.unit_m = unit_m;
  file.taken.elevation_from = "Z";
  if (faces.n_triangles() == 0)
    throw InputError(where_of_layer(source), "no face has an area in plan");
  file.notes.push_back(choice.path + ": layer " + source.name + ", " + sentence_on(counts));
  add_remarks(file.taken, file.notes);
  note_upright(faces, file, choice.path);
  file.tin = faces.take();
  return file;
}

// --- LandXML -------------------------------------------------------------------------------------

struct XmlTree {
  explicit XmlTree(CPLXMLNode* tree) : root(tree, CPLDestroyXMLNode) {}
  std::unique_ptr<CPLXMLNode, decltype(&CPLDestroyXMLNode)> root;
};

// Calls visit(node) for the elements of that name below a node, however deep.
template <class Visit>
void for_each_element(const CPLXMLNode* node, const char* name, const Visit& visit) {
  for (const CPLXMLNode* child = node; child != nullptr; child = child->psNext) {
    if (child->eType != CXT_Element) continue;
    if (std::strcmp(child->pszValue, name) == 0)
      visit(child);
    else
      for_each_element(child->psChild, name, visit);
  }
}

std::vector<std::string> words_of(const CPLXMLNode* node) {
  std::istringstream stream(CPLGetXMLValue(node, nullptr, ""));
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

// Metres in one unit of plan and heights: the unit of the user, else the file must say metres.
double unit_of_landxml(const CPLXMLNode* root, const std::string& path, double user_unit_m) {
  if (user_unit_m > 0) return user_unit_m;
  const auto check = [&](const CPLXMLNode* units, const char* attribute, const char* otherwise) {
    const std::string unit = CPLGetXMLValue(units, attribute, otherwise);
    const double metres = metres_in(unit);
    if (metres == 1) return;
    throw InputError(
        {path}, std::string(attribute) + " is " + unit + ", expected meter",
        "--unit-m " + (metres > 0 ? text(metres, 10) : "METRES") + " scales plan and heights");
  };
  for_each_element(root, "Imperial",
                   [&](const CPLXMLNode* units) { check(units, "linearUnit", "foot"); });
  for_each_element(root, "Metric", [&](const CPLXMLNode* units) {
    check(units, "linearUnit", "meter");
    check(units, "elevationUnit", "meter");
  });
  return 1;
}

// The only surface, or that called `layer`.
const CPLXMLNode* chosen_surface(const CPLXMLNode* root, const std::string& path,
                                 const std::string& layer) {
  std::vector<const CPLXMLNode*> surfaces;
  std::vector<std::string> names;
  for_each_element(root, "Surface", [&](const CPLXMLNode* surface) {
    const std::string name = CPLGetXMLValue(surface, "name", "unnamed");
    if (layer.empty() || layer == name) surfaces.push_back(surface);
    names.push_back(name);
  });
  if (surfaces.size() != 1)
    throw InputError({path},
                     std::to_string(surfaces.size()) + " surfaces" +
                         (layer.empty() ? "" : " called " + layer) + ", expected one" +
                         (names.empty() ? "" : "; there are: " + list_of(names)),
                     names.empty() ? "export the ground as a surface"
                                   : "choose one: '" + path + "|layername=" + names.front() + "'");
  return surfaces.front();
}

std::map<std::string, int> read_landxml_points(const CPLXMLNode* surface, const std::string& path,
                                               double unit_m, FaceCollector& faces) {
  std::map<std::string, int> number_of;
  for_each_element(surface->psChild, "P", [&](const CPLXMLNode* node) {
    const std::string id = CPLGetXMLValue(node, "id", "");
    const std::vector<std::string> words = words_of(node);
    Vec3 point = Vec3::Zero();  // written as northing, easting, elevation
    const bool is_point = words.size() == 3 && parse_double(words[0], point.y()) &&
                          parse_double(words[1], point.x()) && parse_double(words[2], point.z());
    if (!is_point)
      throw InputError(
          {path, 0, "point " + id},
          std::to_string(words.size()) + " words, expected northing, easting, elevation");
    number_of[id] = faces.new_point(unit_m * point);
  });
  return number_of;
}

std::int64_t read_landxml_faces(const CPLXMLNode* surface, const std::string& path,
                                const std::map<std::string, int>& number_of, FaceCollector& faces) {
  std::int64_t n_invisible = 0;
  for_each_element(surface->psChild, "F", [&](const CPLXMLNode* node) {
    if (std::string(CPLGetXMLValue(node, "i", "0")) == "1") {
      ++n_invisible;
      return;
    }
    std::vector<int> corners;
    for (const std::string& id : words_of(node)) {
      const auto found = number_of.find(id);
      if (found == number_of.end())
        throw InputError({path}, "a face has the point " + id + ", which is not there");
      corners.push_back(found->second);
    }
    if (corners.size() != 3)
      throw InputError(
          {path}, "a face has " + std::to_string(corners.size()) + " points, expected triangles");
    faces.triangle(corners[0], corners[1], corners[2]);
  });
  return n_invisible;
}

std::string crs_of_landxml(const CPLXMLNode* root) {
  std::string crs;
  for_each_element(root, "CoordinateSystem", [&](const CPLXMLNode* node) {
    const std::string code = CPLGetXMLValue(node, "epsgCode", "");
    const bool is_code = !code.empty() && code.find_first_not_of("0123456789") == std::string::npos;
    if (is_code && code != "0") crs = "EPSG:" + code;
  });
  return crs;
}

TinFile read_landxml(const std::string& path, const std::string& layer, double user_unit_m) {
  const GdalErrors errors;
  const XmlTree tree(CPLParseXMLFile(path.c_str()));
  if (!tree.root) throw InputError({path}, "is not complete XML: " + errors.failure());
  CPLStripXMLNamespace(tree.root.get(), nullptr, TRUE);
  const double unit_m = unit_of_landxml(tree.root.get(), path, user_unit_m);
  const CPLXMLNode* const surface = chosen_surface(tree.root.get(), path, layer);
  FaceCollector faces;
  const std::map<std::string, int> number_of = read_landxml_points(surface, path, unit_m, faces);
  const std::int64_t n_invisible = read_landxml_faces(surface, path, number_of, faces);
  if (faces.n_triangles() == 0)
    throw InputError({path}, "the surface has no faces, expected a TIN",
                     "export the surface with its triangles (Faces), not its points alone");
  TinFile file;
  file.notes.push_back(path + ": surface " + CPLGetXMLValue(surface, "name", "unnamed") + ", " +
                       counted(faces.n_triangles(), "triangle") +
                       (n_invisible > 0
                            ? "; " + std::to_string(n_invisible) + " invisible ones left out"
                            : std::string()));
  note_upright(faces, file, path);
  file.tin = faces.take();
  file.tin.crs_wkt = crs_of_landxml(tree.root.get());
  return file;
}

// --- OBJ -----------------------------------------------------------------------------------------

// Some programs write y as the height, which the file does not say.
void doubt_height(const Polyhedron& surface, const std::string& path, std::vector<Doubt>& doubts) {
  Vec3 seen = Vec3::Zero();
  for (int f = 0; f < n_faces(surface); ++f) seen += face_area_vector(surface, f).cwiseAbs();
  if (seen.y() <= seen.z()) return;
  doubts.push_back(doubt_on({path},
                            "more of it is seen along y than from above (" + text(seen.y(), 3) +
                                " and " + text(seen.z(), 3) + " m2): is y the height?",
                            "export it with z up"));
}

// A mesh names neither its unit nor its system. Polygons are cut into fans.
TinFile read_obj(const std::string& path, double user_unit_m) {
  Polyhedron surface = parse_obj(read_file(path), path).surface;
  FaceCollector faces;
  std::vector<int> number;
  for (Vec3& p : surface.vertices) {
    p *= user_unit_m > 0 ? user_unit_m : 1;
    number.push_back(faces.point(p));
  }
  for (int f = 0; f < n_faces(surface); ++f) {
    const std::span<const int> corners = face(surface, f);
    for (std::size_t k = 1; k + 1 < corners.size(); ++k)
      faces.triangle(number[corners[0]], number[corners[k]], number[corners[k + 1]]);
  }
  if (faces.n_triangles() == 0) throw InputError({path}, "no face has an area in plan");
  TinFile file;
  file.notes.push_back(path + ": " + counted(faces.n_triangles(), "triangle") + ", z up");
  doubt_height(surface, path, file.doubts);
  note_upright(faces, file, path);
  file.tin = faces.take();
  return file;
}

TinFile read_ply(const std::string& path) {
  TinFile file;
  file.tin = read_tin(path);
  return file;
}

}  // namespace

bool is_tin_file(const std::string& source) {
  const std::string path = file_of(source);
  return is_ply(path) || is_landxml(path) || is_obj(path) || extension_of(path) == ".dxf";
}

namespace {

TinFile read_any(const LayerRef& choice) {
  const std::string path = file_of(choice.path);
  const bool is_surface = is_landxml(path);
  if (is_obj(path)) return read_obj(path, choice.unit_m);
  if (!is_ply(path) && !is_surface) return read_drawing(choice);
  const SourcePath named = parse_source_path(choice.path);
  if (!is_surface && (path != choice.path || choice.unit_m != 0))
    throw InputError({path}, "has no layers, filter and unit to choose, only a drawing has",
                     "omit --unit-m and what follows the file");
  if (!named.subset.empty())
    throw InputError({path}, "has no filter to choose, only a drawing has", "omit |subset=");
  return is_surface ? read_landxml(path, named.layer, choice.unit_m) : read_ply(path);
}

}  // namespace

namespace {

// Points whose rounding moves them by a part of their distance.
void doubt_rounding(const Tin& tin, const std::string& path, std::vector<Doubt>& doubts) {
  constexpr double least_share = 0.01;
  constexpr std::size_t most_looks = 10000;
  RoundingFinder rounding;
  const std::size_t stride = 1 + tin.points.size() / most_looks;
  for (std::size_t i = 0; i < tin.points.size(); i += stride)
    rounding.add(tin.points[i] + tin.origin);
  const MapWindow data = extent(tin);
  const double spacing = std::sqrt((data.x_max - data.x_min) * (data.y_max - data.y_min) /
                                   static_cast<double>(tin.points.size()));
  if (!(rounding.step() > least_share * spacing)) return;
  doubts.push_back(doubt_on({path},
                            "its coordinates have " + rounding.words() + ", in steps of " +
                                text(rounding.step(), 2) + " m at points " + text(spacing, 2) +
                                " m apart",
                            "write them with more digits, or in double precision"));
}

}  // namespace

TinFile read_tin_file(const LayerRef& choice) {
  TinFile file = read_any(choice);
  const std::string path = file_of(choice.path);
  check_elevations(file.tin.points, file.tin.origin, {path}, "");
  if (!(choice.unit_m > 0)) doubt_rounding(file.tin, path, file.doubts);
  return file;
}

std::string crs_of_tin(const Tin& tin, const SystemsByUser& said, const LayerRef& choice,
                       ImportReading& reading) {
  const std::string& path = choice.path;
  const MapWindow data = extent(tin);
  const std::string own =
      tin.crs_wkt.empty() ? std::string() : crs_from_user(tin.crs_wkt, path + ": its CRS");
  // metres that the user made of feet are in another system than the file says
  const bool is_other = choice.unit_m > 0 && length_unit_m(own) != 1;
  const std::string crs = is_other && said.crs_given
                              ? said.crs
                              : crs_said({path, own, data, true, false}, said, reading.notes);
  if (crs.empty() && said.vertical_crs.empty()) return crs;
  const CrsProblem problem =
      find_crs_problem(crs, {0.5 * (data.x_min + data.x_max), 0.5 * (data.y_min + data.y_max)});
  const std::string way_out =
      "a TIN is not reprojected: make it from the contours with talus-tin --t-srs";
  if (!problem.finding.empty())
    throw InputError(
        {path}, problem.finding,
        is_other ? "name the system of the same projection in metres with --crs "
                   "EPSG:code, or --crs none for local metres"
        : is_local(crs)
            ? "--crs none --unit-m " + text(length_unit_m(crs), 10) +
                  " scales plan and heights to local metres"
            : way_out + " " + (problem.mend_to.empty() ? "EPSG:code" : problem.mend_to));
  CrsExtent place{crs, data};
  place.way_to_other_crs = way_out;
  place.crs_said_in = said.crs_given ? "--crs" : "the file";
  check_place(place, {path}, reading.doubts);
  return with_heights_said(crs, said, path);
}

FoldedEdges find_folded_edges(const Tin& tin) {
  std::vector<std::array<int, 2>> edges;  // as their triangles go round
  edges.reserve(3 * tin.triangles.size());
  for (const auto& corners : tin.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.push_back({corners[k], corners[(k + 1) % 3]});
  std::sort(edges.begin(), edges.end());
  FoldedEdges folded;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i] != edges[i - 1]) continue;  // two on one side, or the third of an edge
    const auto [a, b] = edges[i];
    if (folded.n++ == 0) folded.first = (tin.points[a] + tin.points[b]) / 2;
  }
  return folded;
}

}  // namespace talus
