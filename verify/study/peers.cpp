// Reads tables of other engines' results on the same cases.
#include "verify/study/peers.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/csv.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "base/text.hpp"

namespace talus {
namespace {

using Record = std::map<std::string, std::string>;

// Which rows of which table are a case of ours.
struct PeerTable {
  const char* case_name;
  const char* file;
  const char* error_column;
  std::vector<std::pair<std::string, std::string>> only;  // column, value
};

const std::vector<PeerTable>& peer_tables() {
  static const std::vector<PeerTable> tables = {
      {"slide_20", "sliding.csv", "relerr", {}},
      {"slide_0", "sliding_friction_angles.csv", "relerr", {{"phi", "0"}}},
      {"slide_10", "sliding_friction_angles.csv", "relerr", {{"phi", "10"}}},
      {"slide_25", "sliding_friction_angles.csv", "relerr", {{"phi", "25"}}},
      {"slide_29.9", "sliding_friction_angles.csv", "relerr", {{"phi", "29.9"}}},
      {"oblique", "oblique.csv", "relerr", {}},
      {"rolling", "rolling.csv", "worst_abs_err_deg", {}},
      {"bounce_face", "bounce.csv", "maxrelerr3", {{"shape", "cube"}, {"cor", "0.7"}}},
      {"bounce_corner", "bounce.csv", "maxrelerr3", {{"shape", "tetra"}, {"cor", "0.7"}}},
      {"bounce_elastic", "bounce.csv", "maxrelerr3", {{"cor", "1"}}},
      {"free_spin", "free_rotation.csv", "att_deg", {}},
  };
  return tables;
}

std::vector<Record> read_table(const std::string& path) {
  const std::string content =
      read_file(path, "give the folder of other engines' tables to --peers");
  const bool fill_short_rows = true;  // of runs that failed
  const CsvTable table = parse_csv(content, path, fill_short_rows);
  std::vector<Record> records(table.rows.size());
  for (std::size_t r = 0; r < records.size(); ++r)
    for (std::size_t i = 0; i < table.names.size(); ++i)
      records[r][table.names[i]] = table.rows[r][i];
  return records;
}

const std::string& field(const Record& record, const std::string& name, const std::string& path) {
  const auto at = record.find(name);
  if (at == record.end()) throw InputError({path}, "has no column " + name);
  return at->second;
}

// NaN for text that is not a number: the engine failed there.
double number(const Record& record, const std::string& name, const std::string& path) {
  double value = 0;
  return parse_double(field(record, name, path), value) ? value : std::nan("");
}

std::string name_of(const Record& record, const std::string& path) {
  const std::string tag = field(record, "tag", path);
  return field(record, "engine", path) + " " + field(record, "mode", path) +
         (tag == "-" ? "" : " " + tag);
}

}  // namespace

std::vector<PeerPoint> read_peers(const std::string& folder, const std::string& case_name) {
  std::vector<PeerPoint> points;
  for (const PeerTable& table : peer_tables()) {
    if (case_name != table.case_name) continue;
    const std::string path = folder + "/" + table.file;
    for (const Record& record : read_table(path)) {
      const bool is_ours = std::all_of(
          table.only.begin(), table.only.end(),
          [&](const auto& wanted) { return field(record, wanted.first, path) == wanted.second; });
      const double error = std::abs(number(record, table.error_column, path));
      const double cpu = number(record, "cpu", path);
      if (is_ours && std::isfinite(error) && std::isfinite(cpu))
        points.push_back({name_of(record, path), cpu, error});
    }
  }
  return points;
}

std::vector<PeerSlide> read_peer_slides(const std::string& folder) {
  const std::string path = folder + "/slide39_seeds.csv";
  std::map<std::string, std::pair<PeerSlide, int>> sums;
  for (const Record& record : read_table(path)) {
    const std::string name = name_of(record, path) + ", dt " + field(record, "dt", path);
    auto& [slide, n] = sums[name];
    slide.name = name;
    slide.centre += number(record, "cs", path);
    slide.cpu += number(record, "cpu", path);
    ++n;
  }
  std::vector<PeerSlide> slides;
  for (auto& [name, sum] : sums)
    slides.push_back({name, sum.first.centre / sum.second, sum.first.cpu / sum.second});
  return slides;
}

}  // namespace talus
