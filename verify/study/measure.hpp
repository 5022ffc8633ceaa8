// verify/study/measure.hpp
// Error beside run time: the result of one run of a case, the Pareto front of several, and law
// talus compared with law paper.
#pragma once

#include <string>
#include <vector>

#include "draw/chart.hpp"
#include "verify/cases/verify_cases.hpp"

namespace talus {

/// One line of the table of a study.
struct VerifyRow {
  std::string case_name;
  std::string method;           ///< in the legend; not in the table
  std::string law;              ///< "talus" or "paper"
  int dof = 6;                  ///< unknowns, all blocks
  double dt = 0;                ///< [s]
  double normal_stiffness = 0;  ///< [N/m]; 0: chosen by law talus
  bool strains = false;
  double tolerance_factor = 1;  ///< Settings::tolerance_factor
  int runs = 1;                 ///< that the error is the mean of
  long steps = 0;               ///< of all runs, as iterations and unconverged
  double error = 0;             ///< NaN where the run gave none: not finite, or a block was lost
  std::string norm;             ///< meaning of the error, with its unit
  double cpu = 0;   ///< of a run, start and all steps: median, of an ensemble the mean [s]
  double wall = 0;  ///< with the scene's set-up and an integrated reference [s]
  long iterations = 0, unconverged = 0;
  double largest_penetration = 0;  ///< [m]
  double set_up_cpu = 0;           ///< of the scene: terrain, flags, hulls [s]
  StepFlag flags = StepFlag::none;
};

/// Error of another program on the same case, for the diagram.
struct PeerPoint {
  std::string name;
  double cpu = 0;    ///< [s]
  double error = 0;  ///< in the norm of the case
};

/// An answer that errs by more is none.
inline constexpr double useful_error = 0.1;

/// A case and all that was measured of it.
struct MeasuredCase {
  const VerifyCase* about = nullptr;
  std::vector<VerifyRow> rows;
  std::vector<PeerPoint> peers;  ///< empty: not measured with other engines
  double worst = useful_error;   ///< larger errors are not answers
  double known_to = 0;           ///< uncertainty of the reference: smaller errors count as this
};

/// Names of the bits, joined by "+"; "none".
[[nodiscard]] std::string text_of(StepFlag flags);

/// Runs `c` once, and again until `least_cpu` seconds of processor time or 15 runs are spent.
[[nodiscard]] VerifyRow measure(const VerifyCase& c, const Method& method, double dt,
                                double least_cpu);

/// The table, one line a row, with `machine` and `commit` in each.
[[nodiscard]] std::string csv_of(const std::vector<VerifyRow>& rows, const std::string& machine,
                                 const std::string& commit);

/// Indices of the rows that no other row beats in both error and CPU time, by CPU time. Rows whose
/// error is not finite are none.
[[nodiscard]] std::vector<std::size_t> pareto_front(const std::vector<VerifyRow>& rows);

/// Whether it is one of law talus with its default settings, whatever the step.
[[nodiscard]] inline bool is_default(const VerifyRow& row) { return row.method == "talus"; }

/// Smallest CPU time of law talus, defaults but for the step, at an error of at most `error`;
/// infinite where there is none. Runs whose contacts get so deep that their health is broken do not
/// count.
[[nodiscard]] double cheapest(const std::vector<VerifyRow>& rows, double error);

/// Law talus with its default settings, whatever the step, compared with law paper on one case.
struct LawComparison {
  bool is_on_front = false;  ///< a row of law talus is on the front of both
  bool is_compared = false;  ///< law paper has an error that is an answer
  double least_ratio =
      0;                ///< CPU time of paper over talus at equal error, least over paper's front
  double least_at = 0;  ///< error of law paper there
  double ratio_at_best = 0;  ///< the same at paper's smallest error
  double best_error = 0;     ///< that error
};
/// `rows`: of one case; those that err by more than `worst` are not compared. Where law talus never
/// reaches an error of law paper, the ratios are 0.
[[nodiscard]] LawComparison compare_laws(const std::vector<VerifyRow>& rows,
                                         double worst = useful_error);

/// A ratio of CPU times as the tables show it; "-" for NaN.
[[nodiscard]] std::string ratio_text(double ratio);

/// Error against CPU time, both logarithmic; a curve a method, the front marked. Errors below 1e-16
/// are drawn there.
[[nodiscard]] Chart work_precision_chart(const std::string& title,
                                         const std::vector<VerifyRow>& rows,
                                         const std::vector<PeerPoint>& peers);

/// Draws how far the reference itself is known: errors below mean nothing.
void add_band(Chart& chart, double known_to);

}  // namespace talus
