// libcore/step/stage_clock.hpp
// The stages of an island's step by number and name, and the time that each takes: for benchmarks,
// since reading a clock costs more than some stages.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace talus {

/// Stage n of docs/theory/theory.md, "One step of an island", is number n - 1 here.
enum class IslandStage : std::uint8_t {
  gather_members,
  find_pairs,
  choose_stiffness,
  predict,
  make_contacts,
  find_hits,
  solve,
  check_substep,
  accept
};
inline constexpr std::array<const char*, 9> island_stage_names = {
    "gather_members", "find_pairs", "choose_stiffness", "predict", "make_contacts",
    "find_hits",      "solve",      "check_substep",    "accept"};

class StageTimer;
struct StageClock {
  std::array<double, island_stage_names.size()> seconds{};
  StageTimer* running = nullptr;  ///< innermost
};

/// Gives the time from its construction to its end to a stage, but for that of stages within.
class StageTimer {
 public:
  StageTimer(StageClock* clock, IslandStage stage) : clock_(clock), stage_(stage) {
    if (clock_ == nullptr) return;
    outer_ = clock_->running;
    clock_->running = this;
    begin_ = Clock::now();
  }
  ~StageTimer() {
    if (clock_ == nullptr) return;
    const double spent = std::chrono::duration<double>(Clock::now() - begin_).count();
    clock_->seconds[static_cast<std::size_t>(stage_)] += spent - within_;
    clock_->running = outer_;
    if (outer_ != nullptr) outer_->within_ += spent;
  }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  StageClock* clock_;
  IslandStage stage_;
  Clock::time_point begin_{};
  StageTimer* outer_ = nullptr;
  double within_ = 0;  // spent in stages within [s]
};

}  // namespace talus
