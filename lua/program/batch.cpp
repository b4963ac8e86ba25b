// SPDX-License-Identifier: MIT
#include "program/batch.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <memory>
#include <spawn.h>
#include <string>
#include <system_error>
#include <thread>
#include <unistd.h>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>

extern char** environ;

namespace lacuna::program {

namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

/// The output of a process on one of its streams, in an unnamed file, as it may be long.
class Kept {
public:
    Kept() : file_(std::tmpfile(), std::fclose)
    {
        if (!file_) fail("cannot create a temporary file");
        fcntl(file(), F_SETFD, FD_CLOEXEC);
    }

    [[nodiscard]] int file() const { return fileno(file_.get()); }

    void write_to(std::FILE* stream) const
    {
        char block[1 << 16];
        off_t at = 0;
        for (ssize_t n = 0; (n = pread(file(), block, sizeof block, at)) > 0; at += n)
            std::fwrite(block, 1, static_cast<std::size_t>(n), stream);
    }

private:
    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

struct Process {
    std::string recipe;
    Kept out{}, error{};
    pid_t id = 0;
    bool ended = false;
    int status = 0;
};

/// The options that are passed on to every recipe.
std::vector<std::string> options_of(const CommandLine& line)
{
    std::vector<std::string> words{"--quiet"};
    if (line.verbose) words.emplace_back("--verbose");
    if (line.traceback) words.emplace_back("--traceback");
    if (line.sandbox) {
        words.insert(words.end(), {"--sandbox", "--memory", std::to_string(line.memory), "--seconds",
                                   std::to_string(line.seconds)});
        if (!line.output_dir.empty()) words.insert(words.end(), {"--output-dir", line.output_dir});
    }
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int threads = line.threads > 0 ? line.threads : std::max(1, cores / line.jobs);
    words.insert(words.end(), {"--threads", std::to_string(threads)});
    return words;
}

/// Start a recipe in its own process group, so that it gets Ctrl-C only once, from this process.
Process begin(const Job& job, const std::vector<std::string>& options)
{
    Process process{.recipe = job.recipe};
    std::vector<std::string> words{"lacuna"};
    words.insert(words.end(), options.begin(), options.end());
    words.push_back(job.recipe);
    words.insert(words.end(), job.words.begin(), job.words.end());
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);

    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, process.out.file(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, process.error.file(), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    sigset_t none;
    sigemptyset(&none);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);
    errno = posix_spawn(&process.id, "/proc/self/exe", &actions, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&actions);
    if (errno != 0) fail("cannot start a process");
    return process;
}

/// Blocks signals during its lifetime, for sigwaitinfo().
class HeldSignals {
public:
    HeldSignals()
    {
        std::signal(SIGCHLD, SIG_DFL); // if it were ignored, the end of a process would not be reported
        sigemptyset(&own_);
        sigaddset(&own_, SIGCHLD);
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            struct sigaction now = {};
            sigaction(signal, nullptr, &now);
            if (now.sa_handler != SIG_IGN) sigaddset(&own_, signal); // keep signals that nohup ignores
        }
        sigprocmask(SIG_BLOCK, &own_, &before_);
    }
    ~HeldSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

    [[nodiscard]] int wait() const
    {
        int signal = 0;
        while ((signal = sigwaitinfo(&own_, nullptr)) < 0 && errno == EINTR) {}
        return signal;
    }

private:
    sigset_t own_{}, before_{};
};

/// Collect processes that have ended.
std::size_t reap(std::vector<Process>& processes)
{
    std::size_t ended = 0;
    for (Process& process : processes) {
        if (process.ended || waitpid(process.id, &process.status, WNOHANG) != process.id) continue;
        process.ended = true;
        ++ended;
    }
    return ended;
}

/// Print the output of a process and, if it failed, how.
void tell(const Process& process)
{
    process.out.write_to(stdout);
    std::fflush(stdout);
    process.error.write_to(stderr);
    if (WIFSIGNALED(process.status))
        std::fprintf(stderr, "lacuna: %s ended by signal %d (%s)\n", process.recipe.c_str(),
                     WTERMSIG(process.status), strsignal(WTERMSIG(process.status)));
    else if (WEXITSTATUS(process.status) != 0)
        std::fprintf(stderr, "lacuna: %s failed, exit code %d\n", process.recipe.c_str(),
                     WEXITSTATUS(process.status));
}

} // namespace

Exit run_batch(const CommandLine& line)
{
    const std::vector<std::string> options = options_of(line);
    const HeldSignals signals;
    std::vector<Process> processes;
    processes.reserve(line.batch.size());
    std::size_t running = 0, told = 0;
    int stopped_by = 0;
    const auto is_failed = [](const Process& p) {
        return !WIFEXITED(p.status) || WEXITSTATUS(p.status) != 0;
    };
    for (;;) {
        while (stopped_by == 0 && processes.size() < line.batch.size() &&
               running < static_cast<std::size_t>(line.jobs)) {
            processes.push_back(begin(line.batch[processes.size()], options));
            ++running;
        }
        if (running == 0) break;
        const int signal = signals.wait();
        if (signal != SIGCHLD) {
            stopped_by = signal;
            for (const Process& process : processes) {
                if (!process.ended) kill(process.id, signal);
            }
        }
        running -= reap(processes);
        for (; told < processes.size() && processes[told].ended; ++told) tell(processes[told]);
    }
    if (stopped_by != 0) return stopped_by == SIGINT ? Exit::interrupted : Exit::terminated;
    return std::any_of(processes.begin(), processes.end(), is_failed) ? Exit::failed : Exit::done;
}

} // namespace lacuna::program
