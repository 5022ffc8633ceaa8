// tools/runs/talus_runs.cpp
// Reads the run registry: runs, their inputs and outcomes. Page:
// docs/tools/talus-runs.md
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "store/runs.hpp"
#include "tools/frame/run_record.hpp"
#include "tools/frame/tool.hpp"

namespace {

using talus::Json;

Json files_as_json(const std::vector<talus::RunArtifact>& files) {
  Json list = Json::array();
  for (const auto& file : files)
    list.push_back({{"role", file.role},
                    {"path", file.path},
                    {"sha256", file.sha256},
                    {"bytes", file.n_bytes}});
  return list;
}

Json run_as_json(const talus::RunRecord& run) {
  return {{"id", run.id},
          {"content_id", run.content_id},
          {"tool", run.tool},
          {"version", run.version},
          {"git_commit", run.git_commit},
          {"command_line", run.command_line},
          {"folder", run.folder},
          {"host", run.host},
          {"cpu", run.cpu},
          {"started", run.started},
          {"ended", run.ended},
          {"status", run.status},
          {"exit_code", run.exit_code},
          {"cpu_time_s", run.cpu_time_s},
          {"wall_time_s", run.wall_time_s},
          {"peak_memory_kb", run.peak_memory_kb}};
}

Json details_as_json(const talus::RunRecord& run) {
  Json json = run_as_json(run);
  json["params"] = Json::array();
  for (const auto& p : run.params)
    json["params"].push_back({{"key", p.key}, {"value", p.value}, {"source", p.source}});
  json["inputs"] = files_as_json(run.inputs);
  json["outputs"] = files_as_json(run.outputs);
  json["metrics"] = Json::array();
  for (const auto& m : run.metrics)
    json["metrics"].push_back({{"name", m.name}, {"value", m.value}, {"unit", m.unit}});
  json["checks"] = Json::array();
  for (const auto& c : run.checks)
    json["checks"].push_back(
        {{"name", c.name}, {"value", c.value}, {"limit", c.limit}, {"pass", c.pass}});
  json["events"] = Json::array();
  for (const auto& e : run.events)
    json["events"].push_back({{"time_s", e.time_s}, {"level", e.level}, {"text", e.text}});
  return json;
}

std::string padded(std::string text, size_t width) {
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string one_line(const talus::RunRecord& run) {
  return padded(std::to_string(run.id), 6) + padded(run.content_id, 18) + padded(run.tool, 14) +
         padded(run.started, 22) + padded(run.status, 13) +
         padded(talus::text(run.cpu_time_s, 3) + " s", 10) + run.command_line;
}

std::string as_text(const talus::RunRecord& run) {
  std::string lines = "run " + std::to_string(run.id) + " (" + run.content_id + ")\n";
  const auto line = [&lines](const std::string& name, const std::string& value) {
    lines += "  " + padded(name, 13) + value + "\n";
  };
  line("tool", run.tool + " " + run.version + " (" + run.git_commit + ")");
  line("command", run.command_line);
  line("folder", run.folder);
  line("host", run.host + ", " + run.cpu);
  line("started", run.started + ", ended " + (run.ended.empty() ? "-" : run.ended));
  line("outcome", run.status + ", exit code " + std::to_string(run.exit_code));
  line("cost", talus::text(run.cpu_time_s, 4) + " s CPU, " + talus::text(run.wall_time_s, 4) +
                   " s wall, " + std::to_string(run.peak_memory_kb / 1024) + " MiB");
  for (const auto& p : run.params) line("param", p.key + " = " + p.value + "  (" + p.source + ")");
  for (const auto& f : run.inputs)
    line("input", f.role + ": " + f.path + "  " + f.sha256.substr(0, 16));
  for (const auto& f : run.outputs) line("output", f.path + "  " + f.sha256.substr(0, 16));
  for (const auto& m : run.metrics)
    line("metric", m.name + " = " + talus::text(m.value, 6) + " " + m.unit);
  for (const auto& c : run.checks)
    line("check", c.name + " = " + talus::text(c.value, 6) + ", limit " + talus::text(c.limit, 6) +
                      (c.pass ? ", pass" : ", FAIL"));
  for (const auto& e : run.events) line(e.level, e.text);
  lines.pop_back();
  return lines;
}

// The ancestry of a file, found by content: the run that wrote it, that run's inputs, and so on.
struct Ancestry {
  std::string db;
  std::string text;
  std::set<std::int64_t> shown;

  // `before`: only earlier runs can have made it (a run's output may equal its input).
  Json add(const std::string& path, const std::string& sha256, int depth, std::int64_t before) {
    const std::string indent(2 * static_cast<size_t>(depth), ' ');
    text += indent + path + "  " + sha256.substr(0, 16) + "\n";
    Json node = {{"path", path}, {"sha256", sha256}};
    const auto ids =
        sha256.empty() ? std::vector<std::int64_t>{} : talus::runs_that_wrote(db, sha256);
    const auto id = std::find_if(ids.begin(), ids.end(), [before](auto i) { return i < before; });
    if (id == ids.end()) return node;
    const talus::RunRecord run = talus::read_run(db, std::to_string(*id));
    node["run"] = run_as_json(run);
    text += indent + "  by run " + std::to_string(run.id) + ": " + run.command_line + "\n";
    if (!shown.insert(run.id).second) {
      text += indent + "    (its inputs stand above)\n";
      return node;
    }
    node["inputs"] = Json::array();
    for (const auto& file : run.inputs)
      node["inputs"].push_back(add(file.path, file.sha256, depth + 2, run.id));
    return node;
  }
};

// The registry beside a file or one folder up; `otherwise` where none is found.
std::string registry_near(const std::string& file, const std::string& otherwise) {
  const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
  for (const auto& place : {folder, folder.parent_path()})
    if (std::filesystem::exists(place / "runs.sqlite")) return (place / "runs.sqlite").string();
  return otherwise;
}

// --- W3C PROV
// --------------------------------------------------------------------------------------

std::string entity_id(const talus::RunArtifact& file) {
  return "talus:file/" + (file.sha256.empty() ? file.path : file.sha256);
}

Json entity_of(const talus::RunArtifact& file) {
  return {{"prov:label", std::filesystem::path(file.path).filename().string()},
          {"prov:atLocation", file.path},
          {"talus:sha256", file.sha256},
          {"talus:bytes", file.n_bytes}};
}

Json activity_of(const talus::RunRecord& run) {
  Json activity = {{"prov:label", run.tool},
                   {"prov:startTime", run.started},
                   {"talus:content_id", run.content_id},
                   {"talus:command_line", run.command_line},
                   {"talus:folder", run.folder},
                   {"talus:status", run.status}};
  if (!run.ended.empty()) activity["prov:endTime"] = run.ended;
  for (const auto& p : run.params) activity["talus:param/" + p.key] = p.value;
  return activity;
}

// W3C PROV-JSON (https://www.w3.org/submissions/prov-json/) of the runs that led to a file.
Json prov_of(const std::string& db, const std::set<std::int64_t>& ids) {
  Json prov = {{"prefix", {{"talus", "urn:talus:"}}}};
  for (const char* key :
       {"entity", "activity", "agent", "used", "wasGeneratedBy", "wasAssociatedWith"})
    prov[key] = Json::object();
  for (const std::int64_t id : ids) {
    const talus::RunRecord run = talus::read_run(db, std::to_string(id));
    const std::string row = std::to_string(run.id), activity = "talus:run/" + row;
    prov["activity"][activity] = activity_of(run);
    const std::string agent = "talus:tool/" + run.tool + "/" + run.version;
    prov["agent"][agent] = {{"prov:type", "prov:SoftwareAgent"},
                            {"prov:label", run.tool + " " + run.version},
                            {"talus:commit", run.git_commit}};
    prov["wasAssociatedWith"]["_:by" + row] = {{"prov:activity", activity}, {"prov:agent", agent}};
    const auto relate = [&](const char* relation, const char* mark,
                            const std::vector<talus::RunArtifact>& files) {
      int n = 0;
      for (const talus::RunArtifact& file : files) {
        prov["entity"][entity_id(file)] = entity_of(file);
        prov[relation][std::string("_:") + mark + row + "_" + std::to_string(++n)] = {
            {"prov:activity", activity},
            {"prov:entity", entity_id(file)},
            {"prov:role", file.role}};
      }
    };
    relate("used", "used", run.inputs);
    relate("wasGeneratedBy", "made", run.outputs);
  }
  return prov;
}

void show_ancestry(talus::Tool& tool, const std::string& db, const std::string& file, bool prov) {
  Ancestry ancestry{db, {}, {}};
  Json node = ancestry.add(std::filesystem::absolute(file).string(), talus::sha256_of_file(file), 0,
                           std::numeric_limits<std::int64_t>::max());
  if (!node.contains("run"))
    throw talus::InputError({file}, "no run in " + db + " wrote a file with this content",
                            "name the registry that stands beside the output with --db");
  ancestry.text.pop_back();
  if (!prov) {
    tool.listing(std::move(node), ancestry.text);
    return;
  }
  Json document = prov_of(db, ancestry.shown);
  const std::string text = talus::json_text(document, 2);
  tool.listing(std::move(document), text);
}

// --- summary and merging
// --------------------------------------------------------------------------------------

// How the runs of a tool ended, and their cost.
struct Outcomes {
  int n_done = 0, n_failed = 0, n_interrupted = 0, n_running = 0;
  double cpu_time_s = 0;
  std::string first_started, last_ended;

  void add(const talus::RunRecord& run) {
    ++(run.status == "done"          ? n_done
       : run.status == "failed"      ? n_failed
       : run.status == "interrupted" ? n_interrupted
                                     : n_running);
    cpu_time_s += run.cpu_time_s;
    if (first_started.empty() || run.started < first_started) first_started = run.started;
    last_ended = std::max(last_ended, run.ended);
  }
};

Json as_json(const std::string& tool, const Outcomes& o) {
  return {{"tool", tool},
          {"n_done", o.n_done},
          {"n_failed", o.n_failed},
          {"n_interrupted", o.n_interrupted},
          {"n_running", o.n_running},
          {"cpu_time_s", o.cpu_time_s},
          {"first_started", o.first_started},
          {"last_ended", o.last_ended}};
}

std::string summary_line(const std::string& tool, const Outcomes& o) {
  std::string line = padded(tool, 14);
  for (const int n : {o.n_done, o.n_failed, o.n_interrupted, o.n_running})
    line += padded(std::to_string(n), 13);
  return line + padded(talus::text(o.cpu_time_s, 4) + " s", 13) + padded(o.first_started, 22) +
         (o.last_ended.empty() ? "-" : o.last_ended);
}

void show_summary(talus::Tool& tool, const std::string& db) {
  std::map<std::string, Outcomes> of_tool;
  Outcomes all;
  for (const auto& run : talus::list_runs(db)) {
    of_tool[run.tool].add(run);
    all.add(run);
  }
  std::string lines =
      "tool          done         failed       interrupted  running      cpu          first "
      "started   "
      "      last ended";
  Json tools = Json::array();
  for (const auto& [name, outcomes] : of_tool) {
    lines += "\n" + summary_line(name, outcomes);
    tools.push_back(as_json(name, outcomes));
  }
  lines += "\n" + summary_line("all", all);
  tool.listing({{"tools", tools}, {"all", as_json("all", all)}}, lines);
}

void merge(talus::Tool& tool, const std::vector<std::string>& files, const std::string& out) {
  for (const std::string& file : files)
    if (std::filesystem::exists(out) && std::filesystem::exists(file) &&
        std::filesystem::equivalent(out, file))
      throw talus::InputError({file}, "is the registry that is written to itself",
                              "name the others; what is in it already stays");
  const talus::RegistryMerge done = talus::merge_runs(out, files);
  for (const std::string& why : done.left_out)
    tool.warn(why + "; its runs are left out, whatever they wrote is in place");
  tool.listing({{"n_added", done.n_added},
                {"n_completed", done.n_completed},
                {"n_known", done.n_known},
                {"left_out", done.left_out}},
               out + ": " + talus::counted(done.n_added, "run") + " added, " +
                   std::to_string(done.n_completed) + " completed, " +
                   std::to_string(done.n_known) + " were there");
}

// Entries that were taken over are removed.
void adopt_late(talus::Tool& tool, const std::string& db, const std::vector<std::string>& files) {
  int n = 0;
  for (const std::string& file : files) {
    if (std::filesystem::exists(db) && std::filesystem::equivalent(db, file))
      throw talus::InputError({file}, "is the registry itself", "name what stands beside it");
    n += talus::adopt_runs(db, file);
    if (talus::is_late_registry(file)) std::filesystem::remove(file);
  }
  tool.listing({{"n_adopted", n}},
               std::to_string(n) + (n == 1 ? " run" : " runs") + " entered in " + db);
}

}  // namespace

int main(int argc, char** argv) {
  std::string id, file;
  std::string db = "runs.sqlite";
  std::string merged;
  std::vector<std::string> late, parts;
  bool prov = false, summary = false;
  talus::Tool tool("talus-runs",
                   "Reads the run registry: what was run, from what, with which outcome.");
  tool.app().remove_option(tool.app().get_option("--db"));
  tool.app().require_subcommand(1);
  tool.app().fallthrough();
  const CLI::Option* const db_option =
      tool.app()
          .add_option("--db", db, "run registry; trace looks for it beside FILE and one folder up")
          ->capture_default_str();
  CLI::App* list = tool.app().add_subcommand("list", "all runs, a line each");
  list->add_flag("--summary", summary,
                 "a line a tool: how many ended how, CPU time, from when to when");
  CLI::App* show =
      tool.app().add_subcommand("show", "one run with options, files, metrics and events");
  show->add_option("ID", id, "row number, or the beginning of a content id")->required();
  CLI::App* trace =
      tool.app().add_subcommand("trace", "where a file came from, back to the first inputs");
  trace->add_option("FILE", file, "an output of any tool")->required();
  trace->add_flag("--prov", prov, "print the ancestry as W3C PROV-JSON");

  CLI::App* adopt = tool.app().add_subcommand(
      "adopt", "enter the runs that ended while the registry could not be written");
  adopt->add_option("FILE", late, "what such a run left [all beside the registry: DB.late-*]");
  CLI::App* join = tool.app().add_subcommand(
      "merge", "enter all runs of other registries, each once (of shards, of machines)");
  join->add_option("FILE", parts, "registries; they stay as they are")->required();
  join->add_option("-o,--out", merged, "registry to enter them in; made where there is none")
      ->required();

  return tool.run(argc, argv, [&] {
    if (join->parsed()) {
      merge(tool, parts, merged);
    } else if (list->parsed() && summary) {
      show_summary(tool, db);
    } else if (adopt->parsed()) {
      adopt_late(tool, db, late.empty() ? talus::late_registries(db) : late);
    } else if (list->parsed()) {
      Json report;
      Json& runs = report["runs"] = Json::array();
      std::string lines =
          "id    content id        tool          started               outcome      cpu       "
          "command";
      for (const auto& run : talus::list_runs(db)) {  // one of both: there may be 100,000 runs
        if (tool.prints_json())
          runs.push_back(run_as_json(run));
        else
          lines += "\n" + one_line(run);
      }
      tool.listing(report, lines);
    } else if (show->parsed()) {
      const talus::RunRecord run = talus::read_run(db, id);
      tool.listing(details_as_json(run), as_text(run));
    } else {
      if (db_option->count() == 0) db = registry_near(file, db);
      show_ancestry(tool, db, file, prov);
    }
  });
}
