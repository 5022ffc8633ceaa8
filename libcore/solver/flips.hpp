// libcore/solver/flips.hpp: public
// Contacts whose state a step changed: opened, closed, or from stick to slip or back.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "contact/contact.hpp"

namespace talus {

/// Counts them against the memory that the contacts of a block started from.
class FlipCounter {
 public:
  explicit FlipCounter(std::span<const ContactMemory> before) : before_(before) {}

  /// A contact that continues `memory` (-1: none) and ends in state `now`.
  void add(int memory, ContactState now) {
    const bool is_kept = memory >= 0;
    n_kept_ += is_kept;
    const ContactState then =
        is_kept ? static_cast<ContactState>(before_[memory].state) : ContactState::open;
    n_flips_ += now != then;
  }
  /// With those that are out of reach by now.
  [[nodiscard]] int total() const {
    return n_flips_ + std::max(0, static_cast<int>(before_.size()) - n_kept_);
  }

 private:
  std::span<const ContactMemory> before_;
  int n_flips_ = 0, n_kept_ = 0;
};

}  // namespace talus
