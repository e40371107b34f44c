#include "process.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "temporary_folder.hpp"

namespace window_test {
namespace {

namespace fs = std::filesystem;

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

/// Returns "NAME=value" for all variables.
std::vector<std::string> environment_of(const ProcessSetup& setup) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!setup.environment.contains(text.substr(0, text.find('=')))) result.push_back(text);
  }
  for (const auto& [name, value] : setup.environment) {
    if (value) result.push_back(name + "=" + *value);
  }
  return result;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Returns the fields of /proc/PID/stat from the third on. The second, the name, may contain
/// anything.
std::vector<std::string> stat_of(pid_t pid) {
  const std::string text = text_of("/proc/" + std::to_string(pid) + "/stat");
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream fields(text.substr(name_end + 1));
  std::vector<std::string> result;
  for (std::string field; fields >> field;) result.push_back(field);
  return result;
}

}  // namespace

std::optional<std::string> missing_program(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    if (std::system(("command -v " + name + " >/dev/null 2>&1").c_str()) != 0) return name;
  }
  return std::nullopt;
}

Process::Process(const ProcessSetup& setup) {
  std::vector<std::string> words = setup.words;
  std::vector<std::string> variables = environment_of(setup);
  const std::vector<char*> word_pointers = pointers(words);
  const std::vector<char*> variable_pointers = pointers(variables);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("cannot fork");
  if (pid_ > 0) return;
  // A test that is killed leaves nothing running.
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  signal(SIGINT, SIG_DFL);  // a shell's background jobs are started with it ignored
  const int input = open(setup.input.c_str(), O_RDONLY);
  const int output = open(setup.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  const int errors = open(setup.errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(errors, STDERR_FILENO);
  if (setup.descriptor >= 0) dup2(setup.descriptor, 3);
  close_range(setup.descriptor >= 0 ? 4 : 3, ~0u, 0);
  execvpe(word_pointers[0], word_pointers.data(), variable_pointers.data());
  _exit(127);
}

Process::~Process() {
  if (ended()) return;
  send(SIGKILL);
  wait();
}

void Process::send(int signal_number) const { kill(pid_, signal_number); }

std::optional<int> Process::ended() {
  int status = 0;
  if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) {
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
  return status_;
}

int Process::wait() {
  wait_until([this] { return ended().has_value(); });
  return status_.value_or(-1);
}

std::string run(ProcessSetup setup) {
  const frontend::TemporaryFolder folder;
  setup.output = folder / "out";
  setup.errors = folder / "err";
  const int status = Process(setup).wait();
  EXPECT_EQ(status, 0) << testing::PrintToString(setup.words) << '\n' << folder.read("err");
  return folder.read("out");
}

std::size_t open_descriptors(pid_t pid) {
  std::size_t count = 0;
  const fs::directory_iterator entries("/proc/" + std::to_string(pid) + "/fd");
  for ([[maybe_unused]] const auto& entry : entries) ++count;
  return count;
}

std::size_t resident_bytes(pid_t pid) {
  std::istringstream pages(text_of("/proc/" + std::to_string(pid) + "/statm"));
  std::size_t whole = 0, resident = 0;
  pages >> whole >> resident;
  return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

long used_ticks(pid_t pid) {
  const std::vector<std::string> fields = stat_of(pid);
  constexpr std::size_t kUser = 14 - 3, kSystem = 15 - 3;  // proc(5) counts from 1
  if (fields.size() <= kSystem) return -1;
  return std::stol(fields[kUser]) + std::stol(fields[kSystem]);
}

std::size_t children(pid_t pid) {
  const std::string parent = std::to_string(pid);
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::vector<std::string> fields = stat_of(std::stoi(name));
    count += fields.size() > 1 && fields[1] == parent;
  }
  return count;
}

bool is_running(pid_t pid) {
  const std::vector<std::string> fields = stat_of(pid);
  return !fields.empty() && fields[0] != "Z";
}

}  // namespace window_test
