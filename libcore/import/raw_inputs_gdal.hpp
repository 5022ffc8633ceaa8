// libcore/import/raw_inputs_gdal.hpp
// All layers of a request, as they are in their files at first. Each question of the import is put
// to all of them at once and leaves its answer here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "import/height_field_gdal.hpp"
#include "import/layer_reading.hpp"
#include "import/open_layer_gdal.hpp"
#include "import/request.hpp"
#include "terrain/contours.hpp"

namespace talus {

/// The field of a canonical file that holds the id of a line in the file that it comes from.
inline constexpr const char* source_feature_field = "source_feature";

struct RawLayer {
  // open_all
  InputRole role = InputRole::contours;
  OpenLayer source;
  std::string own_crs;  ///< WKT, as the file says; empty: it says none
  /// A point is a line of one point. A ring of an area does not repeat its first point. Without Z a
  /// point has the height 0, or NaN where no heights are asked for.
  Polylines lines;
  std::vector<int> polygon;          ///< of each ring; rings of one follow its outline  (n_lines)
  bool has_z = true;                 ///< of every line
  std::int64_t n_flat = 0;           ///< lines without Z
  std::int64_t n_no_number = 0;      ///< lines with a Z that is not a number
  std::optional<HeightField> field;  ///< that may hold the heights
  std::vector<std::vector<std::string>> attributes;  ///< as text; empty: not set   (n_points)
  LayerReading taken;
  const RequestedLayer* written = nullptr;  ///< in the site file; null: `source` is open

  // declare_place
  std::string crs;           ///< WKT of the coordinates; empty: local metres
  bool is_in_frame = false;  ///< in plan

  [[nodiscard]] const std::string& path() const { return source.ref.path; }
  [[nodiscard]] bool has_heights() const { return source.role.heights != HeightsOf::nothing; }
  [[nodiscard]] bool is_of_site() const { return std::string(source.role.input).empty(); }
  void decide(const std::string& question, const std::string& answer, const std::string& why) {
    taken.decisions.push_back({question, answer, why});
  }
  [[nodiscard]] Where where() const;  ///< messages name the layer where no option has the file
};

struct RawInputs {
  const InputsRequest& request;
  std::vector<RawLayer> layers;
  std::string frame;  ///< WKT of the computation, from declare_place on; empty: local metres
  ImportReading reading;

  /// The layer that the frame comes from; null: the request says the frame.
  [[nodiscard]] RawLayer* ground() { return request.has_frame ? nullptr : &layers.front(); }
  [[nodiscard]] RawLayer* find(InputRole role);
};

/// Opens and reads all layers of the request, without a judgement of their content. Throws
/// InputError: no such source, no such layer or several that may be meant, nothing of the shape,
/// missing geometries, polygons that are not sound, coordinates that are not finite.
[[nodiscard]] RawInputs open_all(const InputsRequest& request);

/// Finds the heights of each layer: in Z, in a field, or in the labels beside. Throws
/// InputError where heights are missing, change along a contour or contradict one another.
void declare_heights(RawInputs& raw);
/// As declare_heights() does for contours with labels.
void take_heights_of_labels(RawLayer& contours, RawLayer& labels, RawInputs& raw);

/// Finds the unit of the plan, and scales the plan to the unit of its system. Throws InputError for
/// a drawing in another one.
void declare_plan_units(RawInputs& raw);

/// The system that each layer is in, and the frame that all are taken to. Throws InputError where
/// none is known, or it cannot be computed in.
void declare_place(RawInputs& raw);

/// Finds the unit of the heights, and their system. Throws InputError where the plan is
/// in feet and nothing says it of the heights.
void declare_height_units(RawInputs& raw);

/// Throws InputError where coordinates cannot be in their system, or it cannot be used there.
void check_places(RawInputs& raw);

/// Takes all to the frame in plan and, where it is asked for, in height; heights become metres.
/// Throws InputError where no operation is known.
void take_to_frame(RawInputs& raw);

/// Throws InputError for implausible heights, with their values in other units; `option` sets one,
/// empty: none does.
void check_elevations(const std::vector<Vec3>& points, const Vec3& origin, const Where& where,
                      const std::string& option);
/// Throws InputError where most heights of a layer are far off those of the contours: mixed units.
void check_neighbours(RawInputs& raw);

/// Areas, and where the request wants them magnitudes.
void measure(RawInputs& raw);

/// All of these, in this order.
[[nodiscard]] RawInputs read_inputs(const InputsRequest& request);

/// Lowest and highest Z, in the unit of the lines.
struct HeightRange {
  double low = 0, high = 0;
  int first_sloping = -1;  ///< line that does not keep to one height, -1: none
};
[[nodiscard]] HeightRange heights_of(const Polylines& lines);

}  // namespace talus
