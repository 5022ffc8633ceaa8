// libcore/import/layer_reading.hpp: public
// Report of reading vector sources, for people and for programs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/doubt.hpp"

namespace talus {

/// An answer of the import, and its reason.
struct Decision {
  std::string question;  ///< "unit of heights"
  std::string answer;    ///< "0.3048 m"
  std::string why;       ///< "--elevation-unit-m"
};

/// How large a quantity of a layer is, once it is in metres: a wrong unit shows here.
struct Magnitude {
  std::string quantity;  ///< "x_m"
  std::int64_t n = 0;
  double lowest = 0, median = 0, highest = 0;
  double spread = 0;  ///< half the difference of the 16th and the 84th percentile
};

/// Of one value at least.
[[nodiscard]] Magnitude magnitude_of(const std::string& quantity, std::vector<double> values);

struct LayerReading {
  std::string role;   ///< "contours", "reference_points"
  std::string file;   ///< as it was named
  std::string layer;  ///< or layers, "index, intermediate"
  std::string where;  ///< filter; empty: all features
  std::string noun;   ///< of the features: "polygon"
  std::int64_t n_features = 0;
  int n_parts = 0;                   ///< points, lines or polygons as they were read
  int n_passed_over = 0;             ///< parts of another kind in the same layer
  std::string passed_over;           ///< in words: "2 points, 1 open line"; empty: none
  std::string elevation_from;        ///< "Z" or "field ELEV"; empty: no heights are read
  double area_m2 = 0;                ///< of all polygons, in the frame
  int n_united = 0, n_made = 0;      ///< polygons that met another one, and those made of them
  std::string operation;             ///< sentence: how it was reprojected; empty: it was not
  double unit_m = 1;                 ///< metres in one unit of the heights
  std::vector<std::string> remarks;  ///< sentences: closed lines that are areas, stroked curves
  std::vector<Decision> decisions;   ///< in the order of the questions
  std::vector<Magnitude> magnitudes;
};

/// Findings in all layers of a request, in their order. Sentences are for the user.
struct ImportReading {
  std::vector<LayerReading> layers;
  std::vector<std::string> notes;
  std::vector<std::string> operations;  ///< how places and heights were taken over
  std::vector<Doubt> doubts;
};

}  // namespace talus
