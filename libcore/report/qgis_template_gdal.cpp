// A QGIS project from a template with placeholders.
#include "report/qgis_template_gdal.hpp"

#include <cpl_minixml.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"
#include "io/errors_gdal.hpp"

namespace talus {
namespace {

struct TreeDeleter {
  void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};
using Tree = std::unique_ptr<CPLXMLNode, TreeDeleter>;

// Kinds of items, as a layout names them.
constexpr const char *map_type = "65639", *picture_type = "65640", *label_type = "65641",
                     *legend_type = "65642", *scale_bar_type = "65646";

std::string value_of(const CPLXMLNode* node, const char* name) {
  return CPLGetXMLValue(node, name, "");
}

bool is_element(const CPLXMLNode* node, const char* name) {
  return node->eType == CXT_Element && std::string(node->pszValue) == name;
}

std::vector<CPLXMLNode*> children(CPLXMLNode* node, const char* name) {
  std::vector<CPLXMLNode*> found;
  for (CPLXMLNode* child = node->psChild; child != nullptr; child = child->psNext)
    if (is_element(child, name)) found.push_back(child);
  return found;
}

void set(CPLXMLNode* node, const std::string& attribute, const std::string& value) {
  CPLSetXMLValue(node, ("#" + attribute).c_str(), value.c_str());
}

void remove(CPLXMLNode* parent, CPLXMLNode* node) {
  if (node == nullptr || CPLRemoveXMLChild(parent, node) == 0) return;
  CPLDestroyXMLNode(node);
}

void remove_attribute(CPLXMLNode* node, const std::string& name) {
  for (CPLXMLNode* child = node->psChild; child != nullptr; child = child->psNext)
    if (child->eType == CXT_Attribute && name == child->pszValue) return remove(node, child);
}

CPLXMLNode* literal(const std::string& xml) {
  return CPLCreateXMLNode(nullptr, CXT_Literal, xml.c_str());
}

// Puts ready XML before the content of the element.
void put_first(CPLXMLNode* parent, const std::string& xml) {
  CPLXMLNode* const node = literal(xml);
  CPLXMLNode** at = &parent->psChild;
  while (*at != nullptr && (*at)->eType == CXT_Attribute) at = &(*at)->psNext;
  node->psNext = *at;
  *at = node;
}

// The element of that name, made where there is none.
CPLXMLNode* element(CPLXMLNode* parent, const char* name) {
  CPLXMLNode* const found = CPLGetXMLNode(parent, name);
  return found != nullptr ? found : CPLCreateXMLNode(parent, CXT_Element, name);
}

// The part of the map that has the shape of its frame and holds the extent.
std::array<double, 4> framed(const std::array<double, 4>& extent, double width, double height) {
  const double cx = (extent[0] + extent[2]) / 2, cy = (extent[1] + extent[3]) / 2;
  const double scale =
      std::max((extent[2] - extent[0]) / width, (extent[3] - extent[1]) / height) / 2;
  return {cx - scale * width, cy - scale * height, cx + scale * width, cy + scale * height};
}

// 1, 2 or 5 times a power of ten, at most `largest`.
double round_length(double largest) {
  const double power = std::pow(10, std::floor(std::log10(largest)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= largest) return factor * power;
  return power;
}

// XML reads a line break in an attribute as a space, so it is written as &#xa;. GDAL writes it as
// it is: until then this private letter replaces it.
constexpr const char* line_break = "\xee\x80\x80";

std::string replaced(std::string words, const std::string& what, const std::string& by) {
  for (std::size_t at = words.find(what); at != std::string::npos;
       at = words.find(what, at + by.size()))
    words.replace(at, what.size(), by);
  return words;
}

void keep_line_breaks(CPLXMLNode* node) {
  for (CPLXMLNode* child = node->psChild; child != nullptr; child = child->psNext)
    if (child->eType == CXT_Element) {
      keep_line_breaks(child);
    } else if (child->eType == CXT_Attribute && child->psChild != nullptr) {
      const std::string value = child->psChild->pszValue;
      if (value.find('\n') != std::string::npos)
        set(node, child->pszValue, replaced(value, "\n", line_break));
    }
}

class Filler {
 public:
  Filler(const QgisProject& project, const QgisTemplate& from) : project_(project), from_(from) {
    const GdalErrors errors;
    tree_.reset(CPLParseXMLString(from.xml.c_str()));
    qgis_ = tree_ ? CPLGetXMLNode(tree_.get(), "=qgis") : nullptr;
    if (qgis_ == nullptr)
      refuse("", "is not a QGIS project: " +
                     (errors.failure().empty() ? "it holds no <qgis>" : errors.failure()));
  }

  [[nodiscard]] std::string xml() {
    fill_words();
    fill_layouts();
    fill_settings();
    fill_layers();
    keep_line_breaks(qgis_);
    const std::unique_ptr<char, decltype(&VSIFree)> out(CPLSerializeXMLTree(tree_.get()), VSIFree);
    return replaced(out.get(), line_break, "&#xa;");
  }

 private:
  [[noreturn]] void refuse(const std::string& item, const std::string& finding) const {
    throw InputError({from_.path, 0, item}, finding,
                     "copy report/project.qgs of share/talus, open the copy in QGIS 3.22 or later, "
                     "and edit its layout there");
  }

  // --- words -------------------------------------------------------------------------------------

  // Values in place of {name}. QGIS evaluates text between [% and %]: no value may be there,
  // and none may make such a pair with its neighbours.
  [[nodiscard]] std::string filled(const std::string& text, const std::string& item,
                                   bool is_html = false) const {
    constexpr const char* letters = "abcdefghijklmnopqrstuvwxyz0123456789_";
    std::string out;
    const auto add = [&out](const std::string& piece, bool is_own) {
      if (!out.empty() && !piece.empty() && out.back() == '[' && piece[0] == '%') out += ' ';
      out += is_own ? piece : without_expressions(piece);
    };
    std::size_t done = 0;
    for (std::size_t at = text.find('{'); at != std::string::npos; at = text.find('{', at + 1)) {
      const std::size_t end = text.find_first_not_of(letters, at + 1);
      if (end == std::string::npos || text[end] != '}' || end == at + 1 ||
          (text[at + 1] >= '0' && text[at + 1] <= '9'))
        continue;  // as in a search pattern
      const std::string name = text.substr(at + 1, end - at - 1);
      const std::size_t open = text.rfind("[%", at), closed = text.rfind("%]", at);
      const bool is_in_expression =
          open != std::string::npos && (closed == std::string::npos || closed < open);
      const auto value = project_.words.find(name);
      if (is_in_expression && value == project_.words.end()) continue;
      if (is_in_expression || value == project_.words.end()) refuse_name(name, item, text);
      add(text.substr(done, at - done), true);
      add(is_html ? replaced(xml_escaped(value->second), "\n", "<br>") : value->second, false);
      done = end + 1;
    }
    add(text.substr(done), true);
    return out;
  }

  [[noreturn]] void refuse_name(const std::string& name, const std::string& item,
                                const std::string& text) const {
    const std::size_t at = from_.xml.find("{" + name + "}");
    const auto n_before = std::count(
        from_.xml.begin(),
        from_.xml.begin() + static_cast<std::ptrdiff_t>(std::min(at, from_.xml.size())), '\n');
    const Where where{from_.path, at == std::string::npos ? 0 : static_cast<int>(n_before) + 1,
                      item};
    if (project_.words.count(name) > 0)
      throw InputError(where, "has {" + name + "} in an expression of QGIS, \"" + text + "\"",
                       "write it outside of [% and %], or make it the value of a project variable "
                       "and name that");
    std::string known;
    std::vector<std::string> names;
    for (const auto& [key, value] : project_.words) {
      known += (known.empty() ? "{" : ", {") + key + "}";
      names.push_back(key);
    }
    const std::string nearest = nearest_name(name, names);
    throw InputError(
        where, "has {" + name + "}, expected one of " + known,
        nearest.empty() ? "take it out of the template" : "did you mean {" + nearest + "}?");
  }

  void fill_attribute(CPLXMLNode* node, const char* name, const std::string& item,
                      bool is_html = false) const {
    const std::string text = value_of(node, name);
    if (text.find('{') != std::string::npos) set(node, name, filled(text, item, is_html));
  }

  void fill_text(CPLXMLNode* node, const std::string& item) const {
    const std::string text = value_of(node, "");
    if (text.find('{') != std::string::npos) CPLSetXMLValue(node, "", filled(text, item).c_str());
  }

  void fill_words() const {
    fill_attribute(qgis_, "projectname", "the project's title");
    if (CPLXMLNode* const title = CPLGetXMLNode(qgis_, "title"))
      fill_text(title, "the project's title");
    for (const char* name : {"projectMetadata.title", "projectMetadata.abstract"})
      if (CPLXMLNode* const node = CPLGetXMLNode(qgis_, name))
        fill_text(node, "the project's metadata");
    if (CPLXMLNode* const values = CPLGetXMLNode(qgis_, "properties.Variables.variableValues"))
      for (CPLXMLNode* value : children(values, "value"))
        fill_text(value, "variables of the project");
  }

  // --- layouts -----------------------------------------------------------------------------------

  void fill_layouts() const {
    CPLXMLNode* const all = CPLGetXMLNode(qgis_, "Layouts");
    const std::vector<CPLXMLNode*> layouts =
        all == nullptr ? std::vector<CPLXMLNode*>() : children(all, "Layout");
    if (layouts.empty()) refuse("", "has no print layout, expected one with a map item");
    for (CPLXMLNode* layout : layouts) fill_layout(layout);
  }

  void fill_layout(CPLXMLNode* layout) const {
    const std::string where = "layout " + value_of(layout, "name");
    const std::vector<CPLXMLNode*> items = children(layout, "LayoutItem");
    double width = 0;  // of the map [m]
    for (CPLXMLNode* item : items)
      if (value_of(item, "type") == map_type) width = std::max(width, fill_map(item, where));
    if (width == 0) refuse(where, "has no map item, expected one");
    for (CPLXMLNode* item : items) {
      const std::string type = value_of(item, "type");
      const std::string place = where + ", item " + value_of(item, "id");
      if (type == label_type)
        fill_attribute(item, "labelText", place, value_of(item, "htmlState") == "1");
      if (type == picture_type) set(item, "file", from_here(value_of(item, "file")));
      if (type == legend_type) fill_attribute(item, "title", place);
      if (type == scale_bar_type) fill_scale_bar(item, width);
    }
  }

  // Returns the width of the shown ground [m].
  [[nodiscard]] double fill_map(CPLXMLNode* item, const std::string& where) const {
    const std::string size = value_of(item, "size");  // "192,152,mm"
    const std::size_t comma = size.find(','), end = size.find(',', comma + 1);
    double width = 0, height = 0;
    if (comma == std::string::npos || !parse_double(size.substr(0, comma), width) ||
        !parse_double(size.substr(comma + 1, end - comma - 1), height) || width <= 0 || height <= 0)
      refuse(where + ", item " + value_of(item, "id"),
             "has the size \"" + size + "\", expected WIDTH,HEIGHT,mm");
    const auto shown = framed(project_.extent, width, height);
    static constexpr const char* names[] = {"xmin", "ymin", "xmax", "ymax"};
    CPLXMLNode* const extent = element(item, "Extent");
    for (std::size_t i = 0; i < 4; ++i) set(extent, names[i], text(shown[i]));
    const double shown_width = std::max(shown[2] - shown[0], 1e-3);
    for (CPLXMLNode* grid : children(item, "ComposerMapGrid"))
      for (const char* name : {"intervalX", "intervalY"})
        set(grid, name, text(round_length(shown_width / 4)));
    return shown_width;
  }

  static void fill_scale_bar(CPLXMLNode* item, double map_width) {
    const double step = round_length(map_width / 10);
    const bool is_long = step >= 1000;
    set(item, "unitType", is_long ? "km" : "meters");
    set(item, "unitLabel", is_long ? "km" : "m");
    set(item, "numMapUnitsPerScaleBarUnit", "1");
    set(item, "numUnitsPerSegment", text(is_long ? step / 1000 : step));
  }

  // --- the project -------------------------------------------------------------------------------

  // A template has no coordinate system, or one that is ignored.
  void fill_crs(CPLXMLNode* node) const {
    for (CPLXMLNode* child = node->psChild; child != nullptr; child = child->psNext) {
      if (child->eType != CXT_Element) continue;
      if (is_element(child, "spatialrefsys") && value_of(child, "wkt").empty()) {
        while (child->psChild != nullptr) remove(child, child->psChild);
        if (!project_.crs_wkt.empty()) put_first(child, crs_parts_xml(project_));
      } else {
        fill_crs(child);
      }
    }
  }

  void fill_settings() const {
    // who saved the template, and when, is not who made the project
    for (const char* name : {"saveUser", "saveUserFull", "saveDateTime"})
      remove_attribute(qgis_, name);
    if (CPLXMLNode* const metadata = CPLGetXMLNode(qgis_, "projectMetadata")) {
      remove(metadata, CPLGetXMLNode(metadata, "creation"));
      remove(metadata, CPLGetXMLNode(metadata, "author"));
    }
    CPLXMLNode* const crs = element(element(qgis_, "projectCrs"), "spatialrefsys");
    while (crs->psChild != nullptr) remove(crs, crs->psChild);
    fill_crs(qgis_);
    CPLSetXMLValue(qgis_, "properties.SpatialRefSys.ProjectionsEnabled", "1");
    CPLSetXMLValue(qgis_, "properties.SpatialRefSys.ProjectionsEnabled.#type", "int");
    if (!project_.is_edited)
      for (CPLXMLNode* node : children(qgis_, "snapping-settings")) remove(qgis_, node);
    // the extent of the last look at the template
    for (CPLXMLNode* node : children(qgis_, "mapcanvas")) remove(qgis_, node);
    if (CPLXMLNode* const view = CPLGetXMLNode(qgis_, "ProjectViewSettings"))
      for (const char* name : {"DefaultViewExtent", "PresetFullExtent"})
        remove(view, CPLGetXMLNode(view, name));
    CPLAddXMLChild(qgis_, literal(map_canvas_xml(project_)));
  }

  // A path that begins where the template lies, from anywhere.
  [[nodiscard]] std::string from_here(const std::string& path) const {
    if (!path.starts_with("./") && !path.starts_with("../")) return path;
    const auto folder = std::filesystem::absolute(from_.path).parent_path();
    return (folder / path).lexically_normal().string();
  }

  void fill_layers() const {
    CPLXMLNode* const own = element(qgis_, "projectlayers");
    for (CPLXMLNode* layer : children(own, "maplayer"))
      if (CPLXMLNode* const source = CPLGetXMLNode(layer, "datasource"))
        CPLSetXMLValue(source, "", from_here(value_of(source, "")).c_str());
    CPLXMLNode* const root = element(qgis_, "layer-tree-group");
    CPLXMLNode* place = nullptr;
    for (CPLXMLNode* group : children(root, "layer-tree-group"))
      if (value_of(group, "name") == "{layers}") place = group;
    if (place == nullptr) {
      put_first(root, layer_tree_xml(project_));
    } else {
      CPLXMLNode* const tree = literal(layer_tree_xml(project_));
      CPLXMLNode** at = &root->psChild;
      while (*at != place) at = &(*at)->psNext;
      tree->psNext = place;
      *at = tree;
      remove(root, place);
    }
    put_first(own, layers_xml(project_));
    put_first(element(qgis_, "layerorder"), layer_order_xml(project_));
  }

  const QgisProject& project_;
  const QgisTemplate& from_;
  Tree tree_;
  CPLXMLNode* qgis_ = nullptr;
};

}  // namespace

QgisTemplate read_qgis_template(const std::string& path) {
  if (!lower(path).ends_with(".qgz")) return {path, read_file(path)};
  const GdalErrors errors;
  const std::string archive = "/vsizip/{" + path + "}";
  const CPLStringList names(VSIReadDir(archive.c_str()));
  for (int i = 0; i < names.size(); ++i) {
    const std::string name = names[i];
    if (!name.ends_with(".qgs")) continue;
    GByte* bytes = nullptr;
    vsi_l_offset n_bytes = 0;
    if (VSIIngestFile(nullptr, (archive + "/" + name).c_str(), &bytes, &n_bytes, -1) == 0) break;
    const std::unique_ptr<GByte, decltype(&VSIFree)> owner(bytes, VSIFree);
    return {path, std::string(bytes, bytes + n_bytes)};
  }
  throw InputError({path}, "holds no .qgs that can be read, expected the archive of a QGIS project",
                   "save the template in QGIS as .qgz or .qgs");
}

std::string qgis_project_xml(const QgisProject& project, const QgisTemplate& from) {
  return Filler(project, from).xml();
}

}  // namespace talus
