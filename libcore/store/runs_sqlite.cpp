// store/runs.hpp with SQLite.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>

#include "base/error.hpp"
#include "base/text.hpp"
#include "store/runs.hpp"

namespace talus {
namespace {

constexpr int schema_version = 1;

constexpr const char* schema = R"sql(
CREATE TABLE run (
  id INTEGER PRIMARY KEY, content_id TEXT NOT NULL, tool TEXT NOT NULL, version TEXT NOT NULL,
  git_commit TEXT NOT NULL, command_line TEXT NOT NULL, folder TEXT NOT NULL, host TEXT NOT NULL,
  cpu TEXT NOT NULL, process_id INTEGER NOT NULL, started TEXT NOT NULL, ended TEXT NOT NULL,
  status TEXT NOT NULL CHECK (status IN ('running', 'done', 'failed', 'interrupted')),
  exit_code INTEGER NOT NULL, cpu_time_s REAL NOT NULL, wall_time_s REAL NOT NULL,
  peak_memory_kb INTEGER NOT NULL) STRICT;
CREATE TABLE param (run_id INTEGER NOT NULL REFERENCES run, key TEXT NOT NULL, value TEXT NOT NULL,
  source TEXT NOT NULL) STRICT;
CREATE TABLE artifact (id INTEGER PRIMARY KEY, path TEXT NOT NULL, sha256 TEXT NOT NULL,
  bytes INTEGER NOT NULL, UNIQUE (path, sha256)) STRICT;
CREATE TABLE run_input (run_id INTEGER NOT NULL REFERENCES run,
  artifact_id INTEGER NOT NULL REFERENCES artifact, role TEXT NOT NULL) STRICT;
CREATE TABLE run_output (run_id INTEGER NOT NULL REFERENCES run,
  artifact_id INTEGER NOT NULL REFERENCES artifact, role TEXT NOT NULL) STRICT;
CREATE TABLE metric (run_id INTEGER NOT NULL REFERENCES run, name TEXT NOT NULL, value REAL,
  unit TEXT NOT NULL) STRICT;
CREATE TABLE event (run_id INTEGER NOT NULL REFERENCES run, time_s REAL NOT NULL,
  level TEXT NOT NULL, text TEXT NOT NULL) STRICT;
CREATE TABLE "check" (run_id INTEGER NOT NULL REFERENCES run, name TEXT NOT NULL, value REAL,
  "limit" REAL, pass INTEGER NOT NULL) STRICT;
CREATE INDEX artifact_sha256 ON artifact (sha256);
CREATE INDEX param_run ON param (run_id);
CREATE INDEX run_input_run ON run_input (run_id);
CREATE INDEX run_output_run ON run_output (run_id);
CREATE INDEX run_output_artifact ON run_output (artifact_id);
CREATE INDEX metric_run ON metric (run_id);
CREATE INDEX event_run ON event (run_id);
CREATE INDEX check_run ON "check" (run_id);
)sql";

constexpr const char* way_out =
    "move it away, name another registry with --db, or run with --no-db";

[[noreturn]] void refuse(const std::string& db, const std::string& finding) {
  throw InputError({db}, finding, way_out);
}

void check_version(SQLite::Database& database, const std::string& db) {
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  if (version != schema_version)
    refuse(db, "is not a run registry of this version (schema " + std::to_string(version) +
                   ", expected " + std::to_string(schema_version) + ")");
}

bool is_empty(SQLite::Database& database) {
  return database.execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
}

// The path in a URI.
std::string escaped(const std::string& path) {
  std::string out;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(byte) || std::strchr("/-_.~", c);
    constexpr const char* digits = "0123456789ABCDEF";
    out += is_plain ? std::string(1, c) : std::string{'%', digits[byte / 16], digits[byte % 16]};
  }
  return out;
}

// Two processes may come to an empty file at once: both wait for the write lock, the second finds
// the tables made.
void make_tables(SQLite::Database& database) {
  SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
  if (is_empty(database)) {
    database.exec(schema);
    database.exec("PRAGMA user_version = " + std::to_string(schema_version));
  }
  transaction.commit();
}

// SQLite would make it writable for its owner alone; its journals have the rights of the file.
void make_file(const std::string& db) {
  const int file = ::open(db.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (file >= 0) ::close(file);  // else SQLite says why
}

SQLite::Database open_to_write(const std::string& db, int wait_ms) {
  make_file(db);
  SQLite::Database database(db, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, wait_ms);
  // The busy handler is not asked when the journal mode changes while another process reads, so
  // the mode is changed only where it is not WAL yet, and tried again until the other one is done.
  for (int attempt = 0; database.execAndGet("PRAGMA journal_mode").getString() != "wal";
       ++attempt) {
    if (20 * attempt > wait_ms) refuse(db, "cannot keep a journal (WAL)");
    try {
      database.exec("PRAGMA journal_mode = WAL");
      if (database.execAndGet("PRAGMA journal_mode").getString() != "wal") sqlite3_sleep(20);
    } catch (const SQLite::Exception& error) {
      if (error.getErrorCode() != SQLITE_BUSY || 20 * attempt > wait_ms) throw;
      sqlite3_sleep(20);
    }
  }
  database.exec("PRAGMA synchronous = NORMAL");
  make_tables(database);
  check_version(database, db);
  return database;
}

bool may_write(const std::string& path) { return ::access(path.c_str(), W_OK) == 0; }

// A copy in a folder that is deleted at once: the open file stays readable.
SQLite::Database open_copy(const std::string& db) {
  std::string folder = (std::filesystem::temp_directory_path() / "talus-runs-XXXXXX").string();
  if (!::mkdtemp(folder.data())) refuse(db, "cannot be copied to " + folder);
  struct Remover {
    std::string folder;
    ~Remover() {
      std::error_code error;
      std::filesystem::remove_all(folder, error);
    }
  } const remover{folder};
  const std::string copy = folder + "/runs.sqlite";
  for (const char* end : {"", "-wal"}) {
    std::error_code error;
    std::filesystem::copy_file(db + end, copy + end, error);
    if (error) refuse(db + end, "cannot be copied to " + folder + ": " + error.message());
  }
  SQLite::Database database(copy, SQLite::OPEN_READWRITE, registry_wait_ms());
  database.exec("SELECT count(*) FROM sqlite_master");
  return database;
}

// A process that may write lets SQLite keep its journal. Any other reads the file as it is, or,
// where a process that was killed left a journal, a copy with it.
SQLite::Database open_there(const std::string& db) {
  if (!std::filesystem::exists(db))
    throw InputError({db}, "there is no such registry", "name it with --db");
  const std::filesystem::path path = std::filesystem::absolute(db);
  if (may_write(db) && may_write(path.parent_path().string())) {
    SQLite::Database database(db, SQLite::OPEN_READWRITE, registry_wait_ms());
    database.exec("PRAGMA query_only = ON");
    return database;
  }
  try {
    SQLite::Database database(db, SQLite::OPEN_READONLY, registry_wait_ms());
    database.exec("SELECT count(*) FROM sqlite_master");
    return database;
  } catch (const SQLite::Exception& error) {
    const int code = error.getErrorCode();
    if (code != SQLITE_CANTOPEN && code != SQLITE_READONLY) throw;
  }
  std::error_code error;
  if (std::filesystem::file_size(db + "-wal", error) > 0 && !error) return open_copy(db);
  return {"file:" + escaped(path.string()) + "?immutable=1",
          SQLite::OPEN_READONLY | SQLite::OPEN_URI, registry_wait_ms()};
}

SQLite::Database open_to_read(const std::string& db) {
  SQLite::Database database = open_there(db);
  check_version(database, db);
  return database;
}

// Faults of the moment, the disk or the rights, not of the registry that was named.
bool may_pass(int code, const std::string& db) {
  switch (code) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_PROTOCOL:
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_NOLFS:
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return true;
    case SQLITE_CANTOPEN:  // the rights, not a name that was misspelt
      return std::filesystem::is_regular_file(db);
    default:
      return false;
  }
}

// SQLite's own errors become input errors that name the registry.
template <class Work>
auto with_registry(const std::string& db, Work&& work) {
  try {
    return work();
  } catch (const SQLite::Exception& error) {
    const std::string finding = std::string("the run registry cannot be used: ") + error.what();
    if (may_pass(error.getErrorCode(), db)) throw RegistryBusy({db}, finding, way_out);
    refuse(db, finding);
  }
}

template <class... Values>
void insert(SQLite::Database& database, const char* sql, const Values&... values) {
  SQLite::Statement statement(database, sql);
  int column = 0;
  (statement.bind(++column, values), ...);
  statement.exec();
}

void insert_files(SQLite::Database& database, const char* table, std::int64_t run_id,
                  const std::vector<RunArtifact>& files) {
  for (const RunArtifact& file : files) {
    insert(database, "INSERT OR IGNORE INTO artifact (path, sha256, bytes) VALUES (?, ?, ?)",
           file.path, file.sha256, file.n_bytes);
    const std::string link = std::string("INSERT INTO ") + table +
                             " SELECT ?, id, ? FROM artifact WHERE path = ? AND sha256 = ?";
    insert(database, link.c_str(), run_id, file.role, file.path, file.sha256);
  }
}

// All data of a run but its outcome; its earlier records are deleted.
void replace_results(SQLite::Database& database, const RunRecord& run) {
  insert(database, "UPDATE run SET content_id = ? WHERE id = ?", run.content_id, run.id);
  for (const char* table : {"run_input", "run_output", "metric", "event", "\"check\""})
    insert(database, (std::string("DELETE FROM ") + table + " WHERE run_id = ?").c_str(), run.id);
  insert_files(database, "run_input", run.id, run.inputs);
  insert_files(database, "run_output", run.id, run.outputs);
  for (const RunMetric& metric : run.metrics)
    insert(database, "INSERT INTO metric VALUES (?, ?, ?, ?)", run.id, metric.name, metric.value,
           metric.unit);
  for (const RunEvent& event : run.events)
    insert(database, "INSERT INTO event VALUES (?, ?, ?, ?)", run.id, event.time_s, event.level,
           event.text);
  for (const RunCheck& check : run.checks)
    insert(database, "INSERT INTO \"check\" VALUES (?, ?, ?, ?, ?)", run.id, check.name,
           check.value, check.limit, check.pass ? 1 : 0);
}

constexpr const char* run_columns =
    "SELECT id, content_id, tool, version, git_commit, command_line, folder, host, cpu, "
    "process_id, "
    "started, ended, status, exit_code, cpu_time_s, wall_time_s, peak_memory_kb FROM run ";

RunRecord read_columns(SQLite::Statement& row) {
  RunRecord run;
  int i = 0;
  run.id = row.getColumn(i++).getInt64();
  for (std::string* field : {&run.content_id, &run.tool, &run.version, &run.git_commit,
                             &run.command_line, &run.folder, &run.host, &run.cpu})
    *field = row.getColumn(i++).getString();
  run.process_id = row.getColumn(i++).getInt();
  for (std::string* field : {&run.started, &run.ended, &run.status})
    *field = row.getColumn(i++).getString();
  run.exit_code = row.getColumn(i++).getInt();
  run.cpu_time_s = row.getColumn(i++).getDouble();
  run.wall_time_s = row.getColumn(i++).getDouble();
  run.peak_memory_kb = row.getColumn(i++).getInt64();
  return run;
}

std::vector<RunArtifact> read_files(SQLite::Database& database, const std::string& table,
                                    std::int64_t run_id) {
  SQLite::Statement row(database,
                        "SELECT role, path, sha256, bytes FROM " + table +
                            " JOIN artifact ON artifact.id = artifact_id WHERE run_id = ? "
                            "ORDER BY " +
                            table + ".rowid");
  row.bind(1, run_id);
  std::vector<RunArtifact> files;
  while (row.executeStep())
    files.push_back({row.getColumn(0).getString(), row.getColumn(1).getString(),
                     row.getColumn(2).getString(), row.getColumn(3).getInt64()});
  return files;
}

void read_details(SQLite::Database& database, RunRecord& run) {
  SQLite::Statement param(database, "SELECT key, value, source FROM param WHERE run_id = ?");
  for (param.bind(1, run.id); param.executeStep();)
    run.params.push_back({param.getColumn(0).getString(), param.getColumn(1).getString(),
                          param.getColumn(2).getString()});
  run.inputs = read_files(database, "run_input", run.id);
  run.outputs = read_files(database, "run_output", run.id);
  SQLite::Statement metric(database, "SELECT name, value, unit FROM metric WHERE run_id = ?");
  for (metric.bind(1, run.id); metric.executeStep();)
    run.metrics.push_back({metric.getColumn(0).getString(), metric.getColumn(1).getDouble(),
                           metric.getColumn(2).getString()});
  SQLite::Statement event(database, "SELECT time_s, level, text FROM event WHERE run_id = ?");
  for (event.bind(1, run.id); event.executeStep();)
    run.events.push_back({event.getColumn(0).getDouble(), event.getColumn(1).getString(),
                          event.getColumn(2).getString()});
  SQLite::Statement check(database,
                          "SELECT name, value, \"limit\", pass FROM \"check\" WHERE run_id = ?");
  for (check.bind(1, run.id); check.executeStep();)
    run.checks.push_back({check.getColumn(0).getString(), check.getColumn(1).getDouble(),
                          check.getColumn(2).getDouble(), check.getColumn(3).getInt() != 0});
}

std::int64_t insert_running(SQLite::Database& database, const RunRecord& run) {
  insert(database,
         "INSERT INTO run (content_id, tool, version, git_commit, command_line, folder, host, "
         "cpu, process_id, started, ended, status, exit_code, cpu_time_s, wall_time_s, "
         "peak_memory_kb) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, '', 'running', -1, 0, 0, 0)",
         run.content_id, run.tool, run.version, run.git_commit, run.command_line, run.folder,
         run.host, run.cpu, run.process_id, run.started);
  const std::int64_t id = database.getLastInsertRowid();
  for (const RunParam& param : run.params)
    insert(database, "INSERT INTO param VALUES (?, ?, ?, ?)", id, param.key, param.value,
           param.source);
  insert_files(database, "run_input", id, run.inputs);
  return id;
}

// The row of a run that has begun: the one it was given, if that is still its own. Somebody may
// have removed the registry since, and another run may have that number in the new one.
std::int64_t row_of(SQLite::Database& database, const RunRecord& run) {
  SQLite::Statement row(database,
                        "SELECT id FROM run WHERE tool = ? AND host = ? AND process_id = ? AND "
                        "started = ? AND folder = ? AND command_line = ? ORDER BY id = ? DESC");
  row.bind(1, run.tool);
  row.bind(2, run.host);
  row.bind(3, run.process_id);
  row.bind(4, run.started);
  row.bind(5, run.folder);
  row.bind(6, run.command_line);
  row.bind(7, run.id);
  return row.executeStep() ? row.getColumn(0).getInt64() : insert_running(database, run);
}

// The row `run.id` as it is now: also of a run in progress.
void complete(SQLite::Database& database, const RunRecord& run) {
  replace_results(database, run);
  insert(database,
         "UPDATE run SET ended = ?, status = ?, exit_code = ?, cpu_time_s = ?, wall_time_s = ?, "
         "peak_memory_kb = ? WHERE id = ?",
         run.ended, run.status, run.exit_code, run.cpu_time_s, run.wall_time_s, run.peak_memory_kb,
         run.id);
}

std::int64_t begin_row(const std::string& db, const RunRecord& run, int wait_ms) {
  return with_registry(db, [&] {
    SQLite::Database database = open_to_write(db, wait_ms);
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
    const std::int64_t id = insert_running(database, run);
    transaction.commit();
    return id;
  });
}

std::vector<RunRecord> read_rows(SQLite::Database& database) {
  SQLite::Statement row(database, std::string(run_columns) + "ORDER BY id");
  std::vector<RunRecord> runs;
  while (row.executeStep()) runs.push_back(read_columns(row));
  return runs;
}

bool is_same_run(const RunRecord& a, const RunRecord& b) {
  return a.tool == b.tool && a.host == b.host && a.process_id == b.process_id &&
         a.started == b.started;
}

// --- merging -----------------------------------------------------------------------------------

// Distinguishes one run from all other runs. Process numbers repeat in containers, so the folder
// and the command line of its start count too.
std::string identity_of(const RunRecord& run) {
  std::string words;
  for (const std::string& word : {run.tool, run.host, std::to_string(run.process_id), run.started,
                                  run.folder, run.command_line})
    words += word + '\n';
  return words;
}

struct RunSource {
  RunRecord run;
  std::string db;  ///< path of its registry
};

std::vector<RunSource> read_source(const std::string& db) {
  return with_registry(db, [&] {
    std::vector<RunSource> sources;
    SQLite::Database database = open_there(db);
    if (is_empty(database)) return sources;  // a tool was killed before its first entry
    check_version(database, db);
    for (RunRecord& run : read_rows(database)) {
      read_details(database, run);
      sources.push_back({std::move(run), db});
    }
    return sources;
  });
}

// Those that cannot be read are named in `left_out`; all of them: refused.
std::vector<RunSource> read_sources(const std::vector<std::string>& files,
                                    std::vector<std::string>& left_out) {
  std::vector<RunSource> sources;
  for (const std::string& db : files) {
    try {
      const std::vector<RunSource> read = read_source(db);
      sources.insert(sources.end(), read.begin(), read.end());
    } catch (const RegistryBusy&) {
      throw;
    } catch (const InputError& error) {
      if (!std::filesystem::exists(db) || left_out.size() + 1 == files.size()) throw;
      left_out.emplace_back(error.what());
    }
  }
  // Ancestry goes by rows: a run comes after those that made its inputs.
  std::stable_sort(sources.begin(), sources.end(), [](const RunSource& a, const RunSource& b) {
    return a.run.started < b.run.started;
  });
  return sources;
}

class RegistryMerger {
 public:
  RegistryMerger(SQLite::Database& database, std::string db)
      : database_(database), db_(std::move(db)) {
    for (const RunRecord& run : read_rows(database)) known_[identity_of(run)] = {run.id, db_};
  }

  void take(const RunSource& source) {
    RunRecord run = source.run;
    const auto known = known_.find(identity_of(run));
    if (known == known_.end()) {
      run.id = insert_running(database_, run);
      complete(database_, run);
      known_[identity_of(run)] = {run.id, source.db};
      ++merge.n_added;
      return;
    }
    run.id = known->second.id;
    const RunRecord there = row(run.id);
    if (run == there || run.status == "running") {
      ++merge.n_known;
    } else if (there.status == "running") {
      complete(database_, run);
      ++merge.n_completed;
    } else {
      refuse_difference(source, there, known->second.db);
    }
  }

  RegistryMerge merge;

 private:
  struct Place {
    std::int64_t id;
    std::string db;
  };

  [[nodiscard]] RunRecord row(std::int64_t id) {
    SQLite::Statement statement(database_, std::string(run_columns) + "WHERE id = ?");
    statement.bind(1, id);
    statement.executeStep();
    RunRecord run = read_columns(statement);
    read_details(database_, run);
    return run;
  }

  [[noreturn]] static void refuse_difference(const RunSource& source, const RunRecord& there,
                                             const std::string& other_db) {
    throw InputError({source.db},
                     "run " + std::to_string(source.run.id) + " (" + there.tool + " on " +
                         there.host + ", process " + std::to_string(there.process_id) +
                         ", started " + there.started + ") is not as it stands in " + other_db,
                     "one of them was changed or damaged: leave it out; nothing was merged");
  }

  SQLite::Database& database_;
  std::string db_;
  std::map<std::string, Place> known_;
};

}  // namespace

int registry_wait_ms() {
  constexpr const char* name = "TALUS_REGISTRY_WAIT_S";
  const char* const given = std::getenv(name);
  if (!given) return 60000;
  double seconds = 0;
  if (!parse_double(given, seconds) || seconds < 0 || seconds > 3600)
    throw InputError({name},
                     "is \"" + std::string(given) + "\", not a number of seconds up to 3600",
                     "unset the environment variable, or give it one");
  return static_cast<int>(1000 * seconds);
}

std::int64_t start_run(const std::string& db, const RunRecord& run) {
  return begin_row(db, run, registry_wait_ms());
}

std::int64_t add_run(const std::string& db, const RunRecord& run, int wait_ms) {
  RunRecord row = run;
  row.id = begin_row(db, run, wait_ms);
  finish_run(db, row, wait_ms);
  return row.id;
}

int adopt_runs(const std::string& db, const std::string& other) {
  const std::vector<RunRecord> known =
      std::filesystem::exists(db) ? list_runs(db) : std::vector<RunRecord>{};
  const std::vector<RunRecord> late = list_runs(other);
  for (const RunRecord& row : late) {
    RunRecord run = read_run(other, std::to_string(row.id));
    const auto begun = std::find_if(known.begin(), known.end(), [&run](const RunRecord& r) {
      return r.status == "running" && is_same_run(r, run);
    });
    if (begun == known.end()) {
      add_run(db, run);
      continue;
    }
    run.id = begun->id;
    finish_run(db, run);
  }
  return static_cast<int>(late.size());
}

void record_results(const std::string& db, const RunRecord& run) {
  with_registry(db, [&] {
    SQLite::Database database = open_to_write(db, registry_wait_ms());
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
    RunRecord own = run;
    own.id = row_of(database, run);
    replace_results(database, own);
    transaction.commit();
  });
}

void finish_run(const std::string& db, const RunRecord& run, int wait_ms) {
  with_registry(db, [&] {
    SQLite::Database database = open_to_write(db, wait_ms);
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
    RunRecord own = run;
    own.id = row_of(database, run);
    complete(database, own);
    transaction.commit();
  });
}

RegistryMerge merge_runs(const std::string& db, const std::vector<std::string>& others) {
  std::vector<std::string> left_out;
  const std::vector<RunSource> sources = read_sources(others, left_out);
  return with_registry(db, [&] {
    SQLite::Database database = open_to_write(db, registry_wait_ms());
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
    RegistryMerger merger(database, db);
    for (const RunSource& source : sources) merger.take(source);
    transaction.commit();
    merger.merge.left_out = left_out;
    return merger.merge;
  });
}

std::vector<RunRecord> list_runs(const std::string& db) {
  return with_registry(db, [&] {
    SQLite::Database database = open_to_read(db);
    return read_rows(database);
  });
}

RunRecord read_run(const std::string& db, const std::string& id) {
  return with_registry(db, [&] {
    SQLite::Database database = open_to_read(db);
    SQLite::Statement row(database, std::string(run_columns) +
                                        "WHERE CAST(id AS TEXT) = ?1 OR substr(content_id, 1, "
                                        "length(?1)) = ?1 ORDER BY CAST(id AS TEXT) = ?1 DESC, id "
                                        "DESC LIMIT 1");
    row.bind(1, id);
    if (id.empty() || !row.executeStep())
      throw InputError({db}, "no run has the id " + id, "talus-runs list shows the ids");
    RunRecord run = read_columns(row);
    read_details(database, run);
    return run;
  });
}

std::vector<std::int64_t> runs_that_wrote(const std::string& db, const std::string& sha256) {
  return with_registry(db, [&] {
    SQLite::Database database = open_to_read(db);
    SQLite::Statement row(database,
                          "SELECT DISTINCT run_id FROM run_output JOIN artifact ON artifact.id = "
                          "artifact_id WHERE sha256 = ? ORDER BY run_id DESC");
    row.bind(1, sha256);
    std::vector<std::int64_t> ids;
    while (row.executeStep()) ids.push_back(row.getColumn(0).getInt64());
    return ids;
  });
}

}  // namespace talus
