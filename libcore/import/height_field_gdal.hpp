// libcore/import/height_field_gdal.hpp
// The field of a layer that may hold its heights.
// in:    an open layer, the field that the user names, or the names that such fields usually have
// out:   a value a part; whether text or another field contradicts it
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/thousands.hpp"
#include "import/open_layer_gdal.hpp"

namespace talus {

class HeightField {
 public:
  /// Nothing where no field has a usual name. Throws InputError when the field that the user
  /// names is missing.
  [[nodiscard]] static std::optional<HeightField> find(const OpenLayer& source);

  void add(const OpenLayer& source, const OGRFeature& feature);  ///< of a part, while it is visited
  /// Of each part. Throws InputError for an empty value or one that is not a height, for text that
  /// may have a point between thousands, and where another field with a usual name that varies
  /// contradicts it.
  [[nodiscard]] const std::vector<double>& heights(const OpenLayer& source) const;
  /// NaN where a part has none; not judged.
  [[nodiscard]] const std::vector<double>& values() const { return values_; }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] bool is_by_user() const { return by_user_; }
  [[nodiscard]] bool is_z() const { return index_.empty(); }  ///< the user says the geometries' Z
  [[nodiscard]] bool may_be_z() const { return may_be_z_; }   ///< "Z", and a field has that name

 private:
  struct Rival {
    double low = 0, high = 0;
    std::string contradiction;
  };
  [[nodiscard]] static std::optional<HeightField> by_name(const OpenLayer& source);
  [[nodiscard]] static HeightField by_user(const OpenLayer& source);
  [[nodiscard]] double value_of(const OpenLayer& source, const OGRFeature& feature);
  void add_rival(const OGRFeature& feature, int index);

  std::string name_;
  std::vector<int> index_;                // by layer, which may call it by another name; empty: Z
  std::vector<std::vector<int>> others_;  // by layer: further fields with a usual name
  bool by_user_ = false, may_be_z_ = false;
  std::vector<double> values_;
  std::optional<InputError> problem_;  // of the first value that is not a height
  ThousandsDoubt thousands_;
  std::map<std::string, Rival> rivals_;
};

/// "--elevation-field ", "--elevation-field spots="
[[nodiscard]] std::string field_option(const OpenLayer& source);

/// The field of exactly this name, else one that differs in case alone; -1: none.
[[nodiscard]] int find_index(OGRLayer& layer, const std::string& name);
[[nodiscard]] std::string list_of_fields(OGRLayer& layer);

/// Whether two heights are not the same, by more than a thousandth.
[[nodiscard]] bool differ(double a, double b);

/// Whether the name of a field says that its numbers are feet: "ELEV_FT", "Height (ft)".
[[nodiscard]] bool is_in_feet(const std::string& name);

}  // namespace talus
