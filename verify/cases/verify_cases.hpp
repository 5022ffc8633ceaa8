// verify/cases/verify_cases.hpp
// The cases that talus-verify runs: those of verify/cases/closed_form.hpp and
// verify/cases/block_cases.hpp, with the claim and reference of each, and the settings that it is
// worth running with.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "verify/cases/closed_form.hpp"

namespace talus {

/// k_n of law paper where nothing else is said: that of the paper's benchmarks [N/m].
inline constexpr double paper_stiffness = 5e10;

struct VerifyCase {
  std::string name;       ///< as given on the command line and in file names
  std::string claim;      ///< one sentence
  std::string reference;  ///< closed form or integration it is compared with
  std::string norm;       ///< meaning of the error, with its unit
  std::string test;       ///< test that bounds it
  double bound = 0;       ///< law talus at the default step must stay below, unit of `norm`
  std::function<cases::CaseResult(const CaseSettings&)> run;
  int n_blocks = 1;
  /// Law talus with strains: shorter steps take minutes, or blur hits in a row; 1: is rigid [s].
  double shortest_strained_dt = 0;
  bool has_strains = false;           ///< runs with strains whatever the settings say
  std::vector<double> paper_dt = {};  ///< steps of law paper; empty: those of all cases [s]
};

/// All cases in the order of the report.
[[nodiscard]] const std::vector<VerifyCase>& verify_cases();

/// One method of running a case: law, stiffness, strains, solver tolerance, a ladder of time steps.
struct Method {
  std::string name;  ///< in the legend
  CaseSettings settings;
  std::vector<double> dt;  ///< longest first [s]
};

/// The methods to run `c` with: those of the whole study, or the few that CI has time for.
[[nodiscard]] std::vector<Method> methods_of(const VerifyCase& c, bool full);

}  // namespace talus
