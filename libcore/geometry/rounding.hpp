// libcore/geometry/rounding.hpp: public
// Coordinates that a program has rounded as it wrote them: to numbers of single precision, or to
// some significant digits. Map coordinates lose metres so.
#pragma once

#include <array>
#include <string>

#include "base/types.hpp"

namespace talus {

class RoundingFinder {
 public:
  void add(const Vec3& point);  ///< as the file has it [m]
  /// Largest step between neighbouring numbers [m]; 0: they are not rounded, or they are whole
  /// centimetres.
  [[nodiscard]] double step() const;
  [[nodiscard]] std::string words() const;  ///< "single precision", "7 digits"

 private:
  bool is_single_ = true, is_round_ = true;
  Vec3 single_step_ = Vec3::Zero();
  std::array<int, 3> n_digits_{}, n_before_point_{};  // the most of each axis

  [[nodiscard]] int n_digits() const;  // all that every axis has; 0: they differ, or are many
};

}  // namespace talus
