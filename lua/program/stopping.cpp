// SPDX-License-Identifier: MIT
#include "program/stopping.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <unistd.h>

namespace lacuna::program {

namespace {

// Signal handlers reach nothing but globals; these are the program's only ones.
enum class Stop { none, interrupt, terminate, time };
std::atomic<Stop> g_reason{Stop::none};
std::atomic<Interpreter*> g_interpreter{nullptr};
std::atomic<bool> g_idle{false};

Exit exit_code(Stop reason)
{
    return reason == Stop::interrupt   ? Exit::interrupted
           : reason == Stop::terminate ? Exit::terminated
                                       : Exit::failed;
}

void on_signal(int signal)
{
    const Stop reason = signal == SIGALRM ? Stop::time : signal == SIGINT ? Stop::interrupt : Stop::terminate;
    if (g_idle) {
        if (reason != Stop::interrupt) _exit(static_cast<int>(exit_code(reason)));
        g_reason = reason;
        return;
    }
    Stop before = Stop::none;
    if (!g_reason.compare_exchange_strong(before, reason)) { // asked before, and nothing came of it
        constexpr char kOver[] = "lacuna: stopped: the time limit is over\n";
        if (reason == Stop::time) {
            [[maybe_unused]] const auto written = write(STDERR_FILENO, kOver, sizeof kOver - 1);
        }
        _exit(static_cast<int>(exit_code(reason)));
    }
    if (Interpreter* const interpreter = g_interpreter) interpreter->cancel();
}

} // namespace

void watch_interrupts(Interpreter* interpreter)
{
    g_interpreter = interpreter;
    struct sigaction action = {};
    action.sa_handler = interpreter ? on_signal : SIG_DFL;
    sigaction(SIGINT, &action, nullptr);
    if (!interpreter) return;
    for (const int signal : {SIGALRM, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
    // A file that grows past a limit is then an error of writing, which is told, and not the end.
    std::signal(SIGXFSZ, SIG_IGN);
}

Exit report_stop(double seconds)
{
    const Stop reason = g_reason.exchange(Stop::none);
    if (reason == Stop::time)
        std::fprintf(stderr, "lacuna: stopped: the time limit of %g seconds is over\n", seconds);
    else
        std::fprintf(stderr, "lacuna: %s\n", reason == Stop::terminate ? "terminated" : "interrupted");
    return exit_code(reason == Stop::none ? Stop::interrupt : reason);
}

void begin_idle()
{
    g_idle = true;
    Stop late = Stop::interrupt; // came when the last run was over
    if (!g_reason.compare_exchange_strong(late, Stop::none)) return;
    if (Interpreter* const interpreter = g_interpreter) interpreter->resume();
}

bool end_idle()
{
    g_idle = false;
    return g_reason.exchange(Stop::none) == Stop::interrupt;
}

void report(const ScriptError& error)
{
    std::fprintf(stderr, "lacuna: %s\n", error.what());
    if (!error.traceback.empty()) std::fprintf(stderr, "%s\n", error.traceback.c_str());
}

} // namespace lacuna::program
