// Starts the tools of a batch and reads their messages; they end with it.
#include "tools/batch/processes.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/error.hpp"

namespace talus {
namespace {

// Reads from the returned descriptor; `output` is the one that the child writes it to.
int start(const std::vector<std::string>& words, int output, pid_t& pid) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0)
    throw InputError({words[0]}, std::string("cannot be started: ") + std::strerror(errno));
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  pid = fork();
  if (pid < 0)
    throw InputError({words[0]}, std::string("cannot be started: ") + std::strerror(errno));
  if (pid == 0) {
    setpgid(0, 0);  // an interruption from the terminal comes by the batch, once
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(127);
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
    dup2(ends[1], output);
    execvp(arguments[0], arguments.data());
    const std::string words_of_error =
        words[0] + " cannot be started: " + std::strerror(errno) + "\n";
    static_cast<void>(!write(STDERR_FILENO, words_of_error.data(), words_of_error.size()));
    _exit(127);
  }
  close(ends[1]);
  return ends[0];
}

int waited(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
  return status;
}

}  // namespace

Json output_of(const std::vector<std::string>& words) {
  pid_t pid = -1;
  const int file = start(words, STDOUT_FILENO, pid);
  std::string out;
  std::array<char, 1 << 16> piece{};
  for (ssize_t n = 0; (n = read(file, piece.data(), piece.size())) > 0 || errno == EINTR;) {
    if (n > 0) out.append(piece.data(), static_cast<std::size_t>(n));
    errno = 0;
  }
  close(file);
  const int status = waited(pid);
  Json json = Json::parse_or_null(out);
  if (status != 0 || !json.is_object())
    throw InputError({words[0]}, "refuses what it is asked, see above");
  return json;
}

Process::Process(std::vector<std::string> words) {
  for (const char* word : {"--messages=json", "--progress=json"}) words.emplace_back(word);
  messages_ = start(words, STDERR_FILENO, pid_);
  fcntl(messages_, F_SETFL, O_NONBLOCK);
}

Process::Process(Process&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      messages_(std::exchange(other.messages_, -1)),
      status_(other.status_),
      progress_(other.progress_),
      unread_(std::move(other.unread_)),
      last_error_(std::move(other.last_error_)) {}

Process::~Process() {
  if (messages_ >= 0) close(messages_);
  if (pid_ > 0) {
    stop();
    waited(pid_);
  }
}

void Process::stop() const {
  if (pid_ > 0) kill(pid_, SIGTERM);
}

bool Process::read(const std::function<void(const std::string&, const std::string&)>& take) {
  std::array<char, 1 << 14> piece{};
  ssize_t n = 0;
  while ((n = ::read(messages_, piece.data(), piece.size())) > 0)
    unread_.append(piece.data(), static_cast<std::size_t>(n));
  const bool has_ended = n == 0 || (errno != EAGAIN && errno != EINTR);
  if (has_ended && !unread_.empty()) unread_ += '\n';
  for (std::size_t end = 0; (end = unread_.find('\n')) != std::string::npos;) {
    const std::string line = unread_.substr(0, end);
    unread_.erase(0, end + 1);
    if (line.empty()) continue;
    const Json json = Json::parse_or_null(line);
    const bool is_object = json.is_object();
    if (is_object && json.contains("progress")) {
      progress_ = json["progress"].get<double>();
      continue;
    }
    // the starter of the tool, or the system, writes plain lines
    const std::string level = is_object ? json.value("level", "info") : "info",
                      text = is_object ? json.value("text", "") : line;
    if (level == "error") last_error_ = text;
    take(level, text);
  }
  if (!has_ended) return true;
  status_ = waited(std::exchange(pid_, -1));
  return false;
}

int Process::exit_code() const { return WIFEXITED(status_) ? WEXITSTATUS(status_) : -1; }

std::string Process::why() const {
  if (exit_code() < 0)
    return "did not end by itself: it was killed by signal " + std::to_string(WTERMSIG(status_)) +
           ", or the machine was out of memory";
  if (!last_error_.empty()) return last_error_;
  return exit_code() == 0 ? "did not end by itself: what starts it lost it (no error, and no file)"
                          : "did not end by itself: exit code " + std::to_string(exit_code());
}

}  // namespace talus
