// SPDX-License-Identifier: MIT
#pragma once

#include <lacuna/interpreter.h>

#include <atomic>

namespace lacuna::program {

/// Exit codes of the program.
enum class Exit { done = 0, failed = 1, bad_usage = 2, interrupted = 130, terminated = 143 };

// --- stopping: signal handlers can only use global variables ---------------------------------------------

/// From now on Ctrl-C, SIGTERM, SIGHUP and the alarm cancel `interpreter`, and a second signal ends the
/// process (for Ctrl-C, if it comes at least a second later). Null: Ctrl-C ends the process at once.
void watch_interrupts(Interpreter* interpreter);
/// For a process that runs no recipe: the same signals set `cancel`, which must outlive the handlers.
void watch_interrupts(std::atomic<bool>& cancel);
/// Report on standard error why a run was cancelled, and reset the request. `seconds` is the time limit.
Exit report_stop(double seconds);

/// Until end_idle() nothing runs: Ctrl-C is only recorded, and the other signals end the process.
void begin_idle();
/// Whether Ctrl-C was pressed since begin_idle().
bool end_idle();

/// Print an error on standard error, with its traceback if it has one.
void report(const ScriptError& error);

/// Limit the process: its data segment in memory, and its time by an alarm that first cancels the run and
/// later ends the process.
void limit_process(double megabytes, double seconds);

} // namespace lacuna::program
