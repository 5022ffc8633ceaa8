// The slide of 39 blocks at several settings, as means of many starts.
#include "verify/study/slide_study.hpp"

#include <cmath>
#include <functional>
#include <numeric>

#include "base/text.hpp"

namespace talus {
namespace {

Method law_paper(double stiffness, std::vector<double> dt, bool strains = false) {
  Method method{"paper, k_n " + text(stiffness), {}, std::move(dt)};
  if (strains) method.name += ", strains";
  method.settings.paper.emplace();
  method.settings.normal_stiffness = stiffness;
  method.settings.strains = strains;
  return method;
}

// Law talus with one setting changed.
Method law_talus(const std::string& what, const std::function<void(Settings&)>& change) {
  Method method{"talus, " + what, {}, {1e-2, 5e-3}};
  change(method.settings);
  return method;
}

// Variants first, then the defaults from the longest step. Law paper with the stiffness of the
// paper, and with a softer one, whose hits are resolved by longer steps.
std::vector<Method> slide_methods(bool full) {
  if (!full) return {law_paper(paper_stiffness, {1e-3}), {"talus", {}, {2e-2, 1e-2}}};
  return {law_paper(paper_stiffness, {2e-3, 1e-3, 5e-4, 2e-4, 1e-4}),
          law_paper(5e8, {1e-2, 5e-3, 2e-3, 1e-3, 5e-4, 2e-4}),
          law_paper(paper_stiffness, {1e-3}, true),
          law_talus("k_n 1e8", [](Settings& s) { s.normal_stiffness = 1e8; }),
          law_talus("k_n 5e10", [](Settings& s) { s.normal_stiffness = 5e10; }),
          law_talus("strains", [](Settings& s) { s.strains = true; }),
          law_talus("tolerance x 100", [](Settings& s) { s.tolerance_factor = 100; }),
          law_talus("tolerance x 0.01", [](Settings& s) { s.tolerance_factor = 0.01; }),
          {"talus", {}, {2e-1, 1e-1, 7e-2, 5e-2, 4e-2, 3e-2, 2e-2, 1e-2, 5e-3, 2e-3, 1e-3}}};
}

// One block in a run goes far now and then, which moves the mean of eight runs by half a metre; so
// the compared values and the reference are means of many.
int slide_runs(const Method& method, bool full) {
  if (!full) return 1;
  if (method.settings.paper) return 6;
  return method.name == "talus" ? 96 : 8;
}

double down_the_slope(const Vec3&, const Vec3& now) { return 320 - now.y(); }

}  // namespace

const std::array<VerifyCase, 3>& slide_claims() {
  static const std::array<VerifyCase, 3> claims = [] {
    std::array<VerifyCase, 3> made;
    const char* what[] = {"the mean place of 39 blocks after a slide of 20 s",
                          "the place that nine tenths of them stay before",
                          "the standard deviation of their places"};
    for (std::size_t q = 0; q < made.size(); ++q) {
      made[q].name = std::string(slide_name) + "_" + quantity_names[q];
      made[q].claim = std::string(what[q]) + " hardly hangs on the step";
      made[q].reference = "the shortest steps, extrapolated to none; means of many starts";
      made[q].norm = "m";
      made[q].test = "SlideOf39Blocks.AnswersAgreeBetweenOneAndTenMilliseconds";
      made[q].bound = 0.8;  // half a per cent of the path of the centre
    }
    return made;
  }();
  return claims;
}

SlideStudy study_slide(const SlideData& data, bool full, const ProgressFunction& progress) {
  SlideStudy out;
  const std::vector<Method> methods = slide_methods(full);
  const auto n_settings = static_cast<double>(
      std::accumulate(methods.begin(), methods.end(), std::size_t{0},
                      [](std::size_t n, const Method& m) { return n + m.dt.size(); }));
  for (const Method& method : methods)
    for (const double dt : method.dt) {
      CaseSettings settings = method.settings;
      settings.dt = dt;
      const auto scene = [&](std::uint64_t seed) {
        if (progress) progress(static_cast<double>(out.results.size()) / n_settings);
        return slide_scene(data, settings, seed);
      };
      out.results.push_back(run_ensemble(scene, slide_runs(method, full), full ? 20 : 4,
                                         down_the_slope, settings.paper));
      out.results.back().method = method.name;
    }
  out.reference = reference_of(out.results);
  const auto at_rest = [&data](std::uint64_t) { return slide_scene(data, {}, 0); };
  out.path = out.reference.mean[0] - run_ensemble(at_rest, 1, 0, down_the_slope).mean[0];
  return out;
}

std::vector<MeasuredCase> measured_of(const SlideStudy& study,
                                      const std::vector<PeerSlide>& peers) {
  std::vector<MeasuredCase> out;
  for (std::size_t q = 0; q < quantity_names.size(); ++q) {
    MeasuredCase one;
    one.about = &slide_claims()[q];
    one.rows = rows_of(one.about->name, static_cast<Quantity>(q), study.results, study.reference);
    one.worst = useful_error * study.path;  // [m]
    one.known_to = study.reference.band[q];
    out.push_back(one);
  }
  for (const PeerSlide& peer : peers)
    out[0].peers.push_back({peer.name, peer.cpu, std::abs(peer.centre - study.reference.mean[0])});
  return out;
}

std::string slide_reference(const SlideStudy& study) {
  const char* names[] = {"centre", "nine tenths", "spread"};
  std::string words;
  for (std::size_t q = 0; q < quantity_names.size(); ++q)
    words += (q ? ",\n" : "") + std::string(names[q]) + " " + text(study.reference.mean[q], 5) +
             " ± " + text(study.reference.band[q], 2) + " m";
  return words + ".";
}

}  // namespace talus
