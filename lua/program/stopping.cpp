// SPDX-License-Identifier: MIT
#include "program/stopping.h"

#include <atomic>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <unistd.h>

namespace lacuna::program {

namespace {

// Signal handlers can only use global variables; these are the only ones of the program.
enum class Stop { none, interrupt, terminate, time };
std::atomic<Stop> g_reason{Stop::none};
std::atomic<Interpreter*> g_interpreter{nullptr};
std::atomic<std::atomic<bool>*> g_cancel{nullptr}; ///< in a process that runs no recipe
std::atomic<bool> g_idle{false};
std::atomic<long> g_asked_at{0}; ///< time of the first request to stop [ms]

/// A second Ctrl-C ends the process if the first was at least this long ago: keys may repeat [ms].
constexpr long kOnPurpose = 1000;

long now_ms()
{
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now); // is async-signal-safe
    return now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

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
    if (!g_reason.compare_exchange_strong(before, reason)) { // a stop was requested before, without effect
        if (reason == Stop::interrupt && now_ms() - g_asked_at < kOnPurpose) return;
        constexpr char kOver[] = "lacuna: stopped: the time limit is exceeded\n";
        if (reason == Stop::time) {
            [[maybe_unused]] const auto written = write(STDERR_FILENO, kOver, sizeof kOver - 1);
        }
        _exit(static_cast<int>(exit_code(reason)));
    }
    g_asked_at = now_ms();
    if (Interpreter* const interpreter = g_interpreter) interpreter->cancel();
    if (std::atomic<bool>* const cancel = g_cancel) *cancel = true;
}

void catch_signals()
{
    struct sigaction action = {};
    action.sa_handler = on_signal;
    for (const int signal : {SIGINT, SIGALRM, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
    // Writing a file beyond a limit then gives an error message instead of a signal.
    std::signal(SIGXFSZ, SIG_IGN);
}

} // namespace

void watch_interrupts(Interpreter* interpreter)
{
    g_interpreter = interpreter;
    if (interpreter)
        catch_signals();
    else
        std::signal(SIGINT, SIG_DFL);
}

void watch_interrupts(std::atomic<bool>& cancel)
{
    g_cancel = &cancel;
    catch_signals();
}

Exit report_stop(double seconds)
{
    const Stop reason = g_reason.exchange(Stop::none);
    if (reason == Stop::time)
        std::fprintf(stderr, "lacuna: stopped: the time limit of %g seconds is exceeded\n", seconds);
    else
        std::fprintf(stderr, "lacuna: %s\n", reason == Stop::terminate ? "terminated" : "interrupted");
    return exit_code(reason == Stop::none ? Stop::interrupt : reason);
}

void begin_idle()
{
    g_idle = true;
    Stop late = Stop::interrupt; // a stop that was requested after the last run had ended
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
